// Two sensors around a trace: one writes it while another sensor works, one plays it back.
#pragma once

#include <cstdint>
#include <vector>

#include "ft/golden/trace.hpp"

namespace lasso::golden {

// Passes every call on to `sensor`, and writes it with its answer.
class TraceRecorder final : public Sensor {
 public:
  explicit TraceRecorder(Sensor& sensor) : sensor_(sensor) {}

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  void permit_laser(bool permitted) override { sensor_.permit_laser(permitted); }

  const std::vector<std::uint8_t>& calls() const { return calls_; }

 private:
  void append(ConstBytes bytes) { calls_.insert(calls_.end(), bytes.begin(), bytes.end()); }
  Sensor& sensor_;
  std::vector<std::uint8_t> calls_;
};

// Answers as the trace says, as long as it is asked what the trace says, bit for bit. From the first difference on it says kTimeout.
class TracePlayer final : public Sensor {
 public:
  // `calls` outlives the player.
  explicit TracePlayer(ConstBytes calls) : calls_(calls) {}

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  void permit_laser(bool /*permitted*/) override {}  // the trace is of one that was

  bool differs() const { return differs_; }
  std::size_t position() const { return calls_.position(); }  // bytes into the calls: where it stopped, once it differs
  std::uint32_t scans() const { return scans_; }              // begun
  bool finished() const { return !differs_ && calls_.remaining() == 0; }

 private:
  // Is this the trace's next call?
  bool next_is(ConstBytes call);
  ByteReader calls_;
  std::uint32_t scans_ = 0;
  bool differs_ = false;
};

}  // namespace lasso::golden
