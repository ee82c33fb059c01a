// The stereo head as a sensor of the component: at the begin of each scan a pair is taken of all that is in view, and matched.
#pragma once

#include <memory>
#include <mutex>

#include "mdat/common/flight_image.hpp"
#include "mdat/render/scene.hpp"
#include "mdat/stereo/matcher.hpp"
#include "mdat/stereo/stereo_head.hpp"

namespace lasso::mdat {

// What a ray of a plan finds in a map: the range to the point of the pixel that it falls on, along the pixel's own direction; kInvalid
// where nothing was matched. Never a miss: a dark pixel may be shadow as well as sky.
RangeSample stereo_sample(const DisparityMap& map, const Vec3& direction, TimeUs t_us);

// A pair of pictures, matched. `t_us` since frame 0. Throws InputError or RunError.
using MatchedPairAt = std::function<DisparityMap(TimeUs t_us)>;

class StereoSensor final : public Sensor {
 public:
  explicit StereoSensor(MatchedPairAt pair) : pair_(std::move(pair)) {}

  // A global shutter: all samples have the time of the start. kBusy while a scan runs, kBadValue for a plan that validate (pattern.hpp)
  // refuses, kTimeout where no pair came; failure() then says why.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { running_ = false; }
  std::string failure() const;

 private:
  MatchedPairAt pair_;
  DisparityMap map_;
  ScanPlan plan_;
  TimeUs t_start_us_ = 0;
  std::uint16_t next_ = 0;  // ray
  bool running_ = false;
  mutable std::mutex mutex_;  // failure_: the component's threads ask for scans, another one for it
  std::string failure_;
};

// For SimulationOptions::make_stereo. Keeps the mission by reference. `target_seed`: the run's, of what the simulated target differs in;
// `jobs`: threads that render a picture, of no effect on it.
MakeStereo stereo_maker(const MissionInput& mission, std::uint64_t target_seed, unsigned jobs);

// Whether one of the mission's sensors is a stereo head.
bool has_stereo_head(const MissionSource& source);

}  // namespace lasso::mdat
