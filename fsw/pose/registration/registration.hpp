// Registration of a scan's hits: maximum likelihood for a scanner whose ray directions are known and whose range is noisy.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/registration/match.hpp"
#include "fsw/pose/scan/result.hpp"
#include "fsw/pose/scan/workspace.hpp"

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
  // Other poses that explain the hits about as well (minima.hpp), target axes.
  Mat6 spread = Mat6::Zero();  // of (rotation, translation): joins the covariance
  bool others_apart = false;   // the hits do not show the place along:
  Vec6 axis = Vec6::Zero();    // over (rotation * radius, translation)
};

constexpr std::uint32_t kMinimumPoints = 12;  // of fewer nothing is made

// Share of the returns that the solution explains; below kExplainedShare the pose may sit in a wrong minimum (or the scan has outliers).
double explained_share(const HitSolution& solution);
constexpr double kExplainedShare = 0.99;

// Registers workspace.points from T_target_sensor: rays of half of the points with a wide gate, then of all of them until the step is below
// estimation.stop_* or the pose's own uncertainty; a second look with a wider gate where the first does not explain the scan. At most
// 2 estimation.iterations_max + 3 passes over all points.
HitSolution register_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// Its first look alone: at most estimation.iterations_max + 2 passes over all points.
HitSolution register_first(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// One look of register_hits, as a step of a search: at most estimation.iterations_max + 2 passes over all points. It goes on within the
// pose's own uncertainty, too, as the pose is compared with others of its kind.
enum class RegisterLook : std::uint8_t { kFirst, kSecond };
HitSolution register_look(const Mission& mission, RegisterLook look, const Pose& T_target_sensor, Workspace& workspace);

// What the pose explains of the points as it stands: one pass, no step. `stop` says why there is none from it (kTooFewPoints, kSingular),
// else kNotRun.
HitSolution weigh_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// Moves a solution there, as weigh_hits has it. Iterations and why it stopped stay. False, and nothing moves, where there is no step from
// it.
bool move_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace, HitSolution& hits);

// How badly the solution explains the returns that it could explain: their mean squared residual in sigmas, kUnexplainedCost for one that
// it leaves out. 1e300 without any. Squared residuals are Tukey-weighted, with the kernel of the pass that they are of, which is
// not Tukey's rho: with a kernel of 10 sigmas a return costs most, 15, at 6, and hardly anything just within 10.
double mean_cost(const HitSolution& solution);

// The same of the pose as it stands: one pass, nothing solved.
double cost_of_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// What all returns cost at a pose, squared sigmas: of each Tukey's rho with a kernel of 3.5 sigmas, which is r^2 of a small residual and
// kMostOfAReturn at most. A return that the pose leaves out costs that, too. So a return that passes an edge, or meets it with half of its
// beam, decides nothing. Of `usable` returns, by the mean of those that the pose could explain: where more of them graze the surface, a
// pose is not the better for it. 1e300 where these are fewer than half, or none. One pass, nothing solved; kLast right after one near by.
double bounded_cost(const Mission& mission, const Pose& T_target_sensor, double usable, Lookup lookup, Workspace& workspace);
constexpr double kMostOfAReturn = 4;  // from a sweep of 2 to 16 (docs/experiments/2026-11-29-profile.md)

// A rough start made good enough for register_first, on at most 96 of the points: their centroid, the far field, then slides along the
// target's axes, until 98 % of them lie on the model. Of the slides along an axis three that leave the points closest to the surface are
// aligned with its planes by half of these points (all, of less than 48), and the closest of these is aligned along the rays. Converges
// from about 20 deg and a quarter of the model's size. Bound: 20 + 6 + 6 x (3 x 3 / 2 + 3) passes over these points, and 6 x 13 look-ups of
// a distance and 6 x 3 interpolated ones for each.
Pose align_coarsely(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// Aligns a pose that is about right along the rays: 4 passes over all points on rays, with a gate that shrinks from 4 % of the model's size
// to 1 %.
Pose align_on_rays(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// Aligns a hypothesis of a search by the truncated distance to the model, in 8 passes. Converges from about 20 deg and a tenth of the
// model's size, to within align_on_rays' reach.
struct DistanceAlignment {
  Pose T_target_sensor;
  double distance = 1;  // mean over the points before the last pass, in truncations
};
DistanceAlignment align_on_distances(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

// Both, one after the other.
Pose align_on_both(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace);

}  // namespace lasso
