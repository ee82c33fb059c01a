// Takes the scans that a run's sensors have finished out of where they leave them.
#pragma once

#include <memory>
#include <utility>

#include "hal_sim/sensor_recording.hpp"

namespace lasso::mdat {

class FinishedScans {
 public:
  // `scans`: where the run's sensors leave what they gave; null: nowhere.
  explicit FinishedScans(std::shared_ptr<sim::SensorRecording> scans) : scans_(std::move(scans)) {}

  // Each once, in the order in which they were begun, by the thread that the sensors run in. One that no later scan of its sensor follows
  // may still be under way: it comes with `all` alone.
  sim::SensorRecording take(bool all);

 private:
  std::shared_ptr<sim::SensorRecording> scans_;
  std::size_t taken_ = 0;
};

}  // namespace lasso::mdat
