// Poses and rates between the frames that a mission names: a docking port in the chaser's port, a grapple point in an arm's base.
#pragma once

#include <string>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "mdat/missiondb/scene_source.hpp"

namespace lasso::mdat {

// One pose that the component reported, said of two other frames: `of`, fixed to the target, in `in`, fixed to the sensors, or in its
// origin with axes that turn against it, such as those of LVLH. Both places, and these axes, are known without error. Registration and
// filter as in telemetry, moved with their lever arms.
struct RelativePose {
  double t_s = 0;  // of the scan's reference time, since frame 0
  bool valid = false;
  Pose T_in_of, T_in_of_filtered;
  Twist rates;                     // of the filter: of the frame's origin, in the axes of `in`
  Mat6 covariance = Mat6::Zero();  // of T_in_of: rotation before translation, in the axes of `in`
  Pose truth;
  Twist true_rates;
};

// One of [relative.NAME], over all packets of a run.
struct RelativeRun {
  std::string name;
  std::vector<RelativePose> poses;
};
// Of a run of the scene by its telemetry: packets, one behind the other.
std::vector<RelativeRun> relative_runs(const SceneRun& scene, const std::vector<std::uint8_t>& telemetry);

// Of the valid ones.
struct RelativeFigures {
  std::size_t poses = 0, valid = 0;
  double rms_mm = 0, rms_deg = 0, filtered_rms_mm = 0, filtered_rms_deg = 0;
  double nees = 0;  // mean; 6 where covariances are honest
};
RelativeFigures relative_figures(const RelativeRun& run);

}  // namespace lasso::mdat
