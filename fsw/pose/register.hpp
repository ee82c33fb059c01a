// Registration of a scan's hits: maximum likelihood for a scanner whose ray directions are known and whose range is noisy.
#pragma once

#include "fsw/pose/estimator.hpp"

namespace lasso {

struct HitSolution {
  Pose T_target_sensor;
  Mat6 H = Mat6::Zero();  // information of x = (rotation, translation) in target axes, in units of the assumed noise
  StopReason stop = StopReason::kNotRun;
  std::uint16_t iterations = 0;
  std::uint32_t inliers = 0;
  std::uint32_t usable = 0;  // returns that could have been inliers
  double chi_squared = 0;    // Tukey-weighted, in units of the assumed noise
  double squared_residual_m2 = 0;
};

// Share of the returns that the solution explains; below kExplainedShare the pose may sit in a wrong minimum (or the scan has outliers).
double explained_share(const HitSolution& solution);
constexpr double kExplainedShare = 0.99;

// Registers workspace.points from T_target_sensor: rays of a quarter of the points, then of all of them until the step is below
// estimation.stop_*; a second look with a wider gate where the first does not explain the scan. At most 2 estimation.iterations_max + 3
// passes over all points.
HitSolution register_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// A rough start made good enough for register_hits: centroid, far field, slides along the target's axes. Converges from about 20 deg and a
// quarter of the model's size. Bound: 20 passes and 73 short registrations of a quarter of the points.
Pose approach_from_afar(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// A pose that is about right drawn to the model: 4 passes over all points on rays, with a gate that shrinks from 4 % of the model's size to
// 1 %.
Pose pull_on_rays(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// The hypothesis of a search drawn to the model: 8 passes on the truncated distance to it, then on rays as above. Converges from about
// 20 deg and a tenth of the model's size.
Pose pull_in(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

}  // namespace lasso
