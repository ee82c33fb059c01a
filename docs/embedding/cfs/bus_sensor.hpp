// A sensor at the other end of the software bus: its orders become messages, and messages its samples. Knows nothing of cFS itself.
#pragma once

#include "cfs/payload.h"
#include "fsw/exec/lasso.hpp"

namespace lasso::cfs {

// Where orders go.
class ScannerPort {
 public:
  virtual void send(const LASSO_Scan_Payload_t& order) = 0;

 protected:
  ~ScannerPort() = default;
};

class BusSensor final : public Sensor {
 public:
  explicit BusSensor(ScannerPort& port) : port_(port) {}

  // Whether a message belongs to the scan under way, whose samples it may bring. One that does not changes nothing.
  bool take(const LASSO_Samples_Payload_t& message);

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  void permit_laser(bool permitted) override;

 private:
  void order(std::uint32_t order);

  ScannerPort& port_;
  bool permitted_ = false, running_ = false, complete_ = false;
  std::uint32_t scan_id_ = 0;
  std::uint16_t points_ = 0;
  std::size_t handed_over_ = 0;
  Status status_ = Status::kOk;
  FixedVector<RangeSample, kMaxRays> samples_;
};

// The order for a scan that starts at t_start_us.
LASSO_Scan_Payload_t to_order(const ScanPlan& plan, TimeUs t_start_us);
// The plan of an order, whose aimed rays are put into `aimed` and stay there; validate() says whether it may be scanned.
ScanPlan to_plan(const LASSO_Scan_Payload_t& order, AimedRays& aimed);
LASSO_Sample_t to_message(const RangeSample& sample);
LASSO_Pose_Payload_t to_message(const PoseTelemetry& pose);

}  // namespace lasso::cfs
