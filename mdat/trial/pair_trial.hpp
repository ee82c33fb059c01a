// Single pairs of a simulated stereo head in stated lights: what they measure, and the poses of scans of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/run/statistics.hpp"
#include "mdat/stereo/disparity_errors.hpp"
#include "mdat/stereo/stereo_fit.hpp"
#include "mdat/trial/trial_light.hpp"

namespace lasso::mdat {

constexpr double kTrialTurn_rad = 0.5 * kRadPerDeg, kTrialShift_m = 0.005;  // of starts off the truth, about and along drawn axes

struct TrialOptions {
  std::string scenario;           // empty: as mdat stereo chooses
  std::optional<double> range_m;  // one of the scenario's; none: its first
  std::uint32_t views = 6;        // times of the scenario, spread by the golden ratio
  std::uint32_t scans = 3;        // of each pair, the pattern turned on from one to the next
  std::uint32_t draws = 4;        // of each view by the fitted model, each with noise of its own
  bool rendered = true;           // false: by the fitted model alone, without pictures
  std::vector<TrialLight> lights;
  unsigned jobs = 1;  // threads that render; no effect on the results
};

struct TrialPair {
  std::size_t light = 0;
  std::uint32_t view = 0;
  double time_s = 0, exposure_s = 0;
  DisparityErrors errors;
};

struct TrialPose {
  std::size_t light = 0;
  std::uint32_t view = 0, draw = 0, scan = 0;  // draw: of the fitted model
  PoseReason reason = PoseReason::kNoScan;
  bool wrong = false;  // valid, and wrong (mdat/run/verdict.hpp)
  std::uint16_t returns = 0;
  double off_m = 0, off_rad = 0, sigma_m = 0, sigma_rad = 0;
  double squared_position = 0, squared_attitude = 0;  // normalised, for each axis: 1 where the covariance is honest
  double nees = 0;                                    // 6 then

  bool valid() const { return reason == PoseReason::kValid; }
};

struct TrialResult {
  std::string scenario;
  double range_m = 0;
  std::vector<TrialLight> lights;
  std::vector<TrialPair> pairs;
  std::vector<TrialPose> poses;   // of rendered pairs
  std::vector<TrialPose> fitted;  // the same views by the fitted model
  StereoFit fit;                  // of the rendered pairs of all lights
};

// Times since frame 0 of the views of a scenario that lasts `duration_s`.
std::vector<double> view_times_s(std::uint32_t views, double duration_s);

// Error and verdict of a registration that started off the truth.
TrialPose trial_pose(const Registration& registration, const Pose& truth);

// Throws as make_scene, match_files, and RunError where a view has nothing in the field of view.
TrialResult try_pairs(const CompiledMission& mission, const TrialOptions& options);

}  // namespace lasso::mdat
