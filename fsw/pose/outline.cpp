#include "fsw/pose/outline.hpp"

#include "fsw/pose/model_ray.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kLongestStep = 0.25;  // of the model's radius
constexpr double kReach = 1.5;         // rays that pass the model's centre farther off, in radii, say nothing

bool is_near(const Vec3& center_sensor, double reach_m, const ScanRay<N>& ray) {
  const Vec3 u(N::to_double(ray.u[0]), N::to_double(ray.u[1]), N::to_double(ray.u[2]));
  return center_sensor.cross(u).squaredNorm() < reach_m * reach_m;
}

// Every n-th of the rays that pass near the target, at most kOutlineRays.
void choose_rays(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  const Vec3 center = inverse(T_target_sensor) * mission.center_m;
  const auto is_asked = [&](const ScanRay<N>& ray) {
    return ray.state != RayState::kInvalid && is_near(center, kReach * mission.radius_m, ray);
  };
  std::size_t count = 0;
  for (const ScanRay<N>& ray : workspace.rays) count += is_asked(ray) ? 1u : 0u;
  const std::size_t stride = count > kOutlineRays ? (count + kOutlineRays - 1) / kOutlineRays : 1;
  std::size_t index = 0;
  workspace.outline.clear();
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) {
    if (!is_asked(workspace.rays[i]) || index++ % stride != 0) continue;
    invariant(workspace.outline.push_back({static_cast<std::uint16_t>(i)}), "room for every n-th ray");
  }
}

bool disputes(const Mission& mission, const PathPose<N>& pose, N::Length gate, const ScanRay<N>& ray) {
  const FieldHit<N> met = meet_model(mission, pose, ray);
  if (ray.state == RayState::kMiss) return met.found;
  const N::Length gap = met.t - ray.range;
  return !met.found || gap > gate || -gap > gate;
}

class Slide {
 public:
  Slide(const Mission& mission, const Directions& directions, const OutlineCare& care, Workspace& workspace)
      : mission_(mission), directions_(directions), care_(care), gate_(N::to_length(care.gate_m)), workspace_(workspace) {}

  OutlineFit take(const Pose& start) {
    best_ = start;
    reopen();
    const std::uint32_t before = disputed_;
    double step_m = care_.first_step * mission_.radius_m;
    for (int round = 0; round < kOutlineRounds && step_m > care_.last_step_m; ++round) {
      const bool helps = try_all(step_m);
      helps ? reopen() : close_certain();
      step_m = next_step(step_m, helps);
    }
    reopen();
    return describe(before);
  }

 private:
  double next_step(double step_m, bool helps) const {
    const double longest_m = kLongestStep * mission_.radius_m;
    if (!helps) return 0.5 * step_m;
    return 2 * step_m < longest_m ? 2 * step_m : longest_m;
  }

  bool try_all(double step_m) {
    bool helps = false;
    for (int i = 0; i < directions_.count && asked_ < care_.asked; ++i) {
      if (try_both_ways(i, step_m)) helps = true;
    }
    return helps;
  }

  bool try_both_ways(int i, double step_m) {
    const Vec6 x = directions_.vectors.col(i).cwiseQuotient(radius_scale(mission_.radius_m)) * step_m;
    const std::uint32_t forth = try_pose(step_pose(best_, x));
    if (forth < disputed_) return move(i, step_m, step_pose(best_, x), forth);
    const std::uint32_t back = try_pose(step_pose(best_, -x));
    if (back < disputed_) return move(i, step_m, step_pose(best_, -x), back);
    if (forth >= disputed_ + kFewRays && back >= disputed_ + kFewRays) within_m_[i] = step_m;
    return false;
  }

  // How many rays dispute the pose.
  std::uint32_t try_pose(const Pose& pose) {
    const PathPose<N> path = to_path<N>(pose);
    std::uint32_t count = 0;
    for (OutlineRay& ray : workspace_.outline) {
      ray.tried = ray.open ? ask(path, ray) : ray.disputed;
      ray.doubtful = ray.doubtful || ray.tried != ray.disputed;
      count += ray.tried ? 1u : 0u;
    }
    return count;
  }

  bool ask(const PathPose<N>& pose, const OutlineRay& ray) {
    ++asked_;
    return disputes(mission_, pose, gate_, workspace_.rays[ray.ray]);
  }

  // To the pose that was tried last. Where more rays dispute the pose is now farther off by the step.
  bool move(int i, double step_m, const Pose& pose, std::uint32_t disputed) {
    for (OutlineRay& ray : workspace_.outline) ray.disputed = ray.tried;
    best_ = pose;
    disputed_ = disputed;
    if (within_m_[i] > 0) within_m_[i] += step_m;
    return true;
  }

  // Rays on which no step of a round counted otherwise will not do so in a shorter one.
  void close_certain() {
    for (OutlineRay& ray : workspace_.outline) {
      ray.open = ray.doubtful;
      ray.doubtful = false;
    }
  }

  // Asks all that were not asked of the best pose.
  void reopen() {
    const PathPose<N> path = to_path<N>(best_);
    disputed_ = 0;
    for (OutlineRay& ray : workspace_.outline) {
      if (!ray.open) ray.disputed = ask(path, ray);
      ray.open = true;
      disputed_ += ray.disputed ? 1u : 0u;
    }
  }

  OutlineFit describe(std::uint32_t before) const {
    OutlineFit fit;
    fit.T_target_sensor = best_;
    fit.disputed = disputed_;
    fit.gained = before > disputed_ ? before - disputed_ : 0;
    fit.asked = asked_;
    fit.rays = static_cast<std::uint32_t>(workspace_.outline.size());
    for (const OutlineRay& ray : workspace_.outline) fit.hits += workspace_.rays[ray.ray].state == RayState::kHit ? 1u : 0u;
    fit.settled = disputed_ <= kDisputed * fit.rays + mission_.parameters.dropout_probability * fit.hits + kFewRays;
    if (fit.settled) fit.within_m = within_m_;
    return fit;
  }

  const Mission& mission_;
  const Directions& directions_;
  const OutlineCare& care_;
  N::Length gate_;
  Workspace& workspace_;
  Pose best_;
  std::uint32_t disputed_ = 0;
  std::uint32_t asked_ = 0;
  Vec6 within_m_ = Vec6::Zero();
};

}  // namespace

OutlineFit fit_outline(const Mission& mission, const Pose& T_target_sensor, const Directions& directions, const OutlineCare& care,
                       Workspace& workspace) {
  choose_rays(mission, T_target_sensor, workspace);
  return Slide(mission, directions, care, workspace).take(T_target_sensor);
}

}  // namespace lasso
