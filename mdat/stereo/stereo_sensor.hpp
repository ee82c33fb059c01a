// The stereo head as a sensor of the component: at the begin of each scan a pair is taken of all that is in view.
#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "fsw/sense/sensor.hpp"
#include "mdat/pair/disparity_map.hpp"

namespace lasso::mdat {

// What a ray of a plan finds in a map: the range to the point of the pixel that it falls on, along the pixel's own direction; kInvalid
// where nothing was matched. Never a miss: a dark pixel may be shadow as well as sky.
RangeSample stereo_sample(const DisparityMap& map, const Vec3& direction, TimeUs t_us);

// What the rays of a plan find in one pair: along a direction, at the pair's time.
using PairRanges = std::function<RangeSample(const Vec3& direction, TimeUs t_us)>;
PairRanges ranges_in(DisparityMap map);  // stereo_sample of it

// The pair of a time since frame 0; its ranges are asked for until the next one is taken. Throws InputError or RunError.
using PairAt = std::function<PairRanges(TimeUs t_us)>;

class StereoSensor final : public Sensor {
 public:
  explicit StereoSensor(PairAt pair) : pair_(std::move(pair)) {}

  // A global shutter: all samples have the time of the start. kBusy while a scan runs, kBadValue for a plan that validate (pattern.hpp)
  // refuses, kTimeout where no pair came; failure() then says why.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { running_ = false; }
  void permit_laser(bool /*permitted*/) override {}  // it has none
  std::string failure() const;

 private:
  PairAt pair_;
  PairRanges ranges_;
  ScanPlan plan_;
  TimeUs t_start_us_ = 0;
  std::uint16_t next_ = 0;  // ray
  bool running_ = false;
  mutable std::mutex mutex_;  // failure_: the component's threads ask for scans, another one for it
  std::string failure_;
};

}  // namespace lasso::mdat
