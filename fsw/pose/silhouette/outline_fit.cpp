#include "fsw/pose/silhouette/outline_fit.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/model_ray.hpp"
#include "fsw/pose/silhouette/contour.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kLongestStep = 0.25;  // of the model's radius
constexpr double kReach = 1.5;         // rays that pass the model's centre farther off, in radii, say nothing
constexpr std::uint64_t kWholeTurn = std::uint64_t{1} << 32;
constexpr std::uint32_t kGoldenTurn = 2654435769;  // of it
constexpr std::size_t kUneven = 6;                 // so many more than their share may be chosen
constexpr std::size_t kNearRays = kOutlineRays - kOutlineRays / 5;
constexpr double kNear = 1.5;  // of the first step
constexpr double kGateSigmas = 6;
constexpr double kNever_m = 1e9;
constexpr double kCostSigmas = 3;       // a gap of so many costs a whole ray
constexpr std::uint32_t kQuarters = 4;  // costs are counted in quarters of a ray
constexpr std::uint8_t kDisputed = 5;   // a ray's answer: its cost in quarters, or this: a whole ray, and off beyond the gate

// Of all rays that were asked of a pose.
struct Count {
  std::uint32_t cost = 0;  // quarters of a ray
  std::uint32_t disputed = 0;

  void add(std::uint8_t answer) {
    cost += answer < kQuarters ? answer : kQuarters;
    disputed += answer == kDisputed ? 1u : 0u;
  }
};

bool is_near(const Vec3& center_sensor, double reach_m, const ScanRay<N>& ray) {
  const Vec3 u(N::to_double(ray.u[0]), N::to_double(ray.u[1]), N::to_double(ray.u[2]));
  return (center_sensor - to_vec3(ray.o)).cross(u).squaredNorm() < reach_m * reach_m;
}

// Takes of those that are told one by one as many as there is room for, spread by the golden ratio: a fixed stride would take the same
// columns of each line of a raster.
class Choice {
 public:
  Choice(std::size_t count, std::size_t room) : below_(count > room ? kWholeTurn * (room - kUneven) / count : kWholeTurn) {}

  bool takes_next() {
    turn_ += kGoldenTurn;
    return turn_ < below_;
  }

 private:
  std::uint64_t below_;
  std::uint32_t turn_ = 0;
};

enum class RayPlace : std::uint8_t { kAside, kElsewhere, kNearContour };

// Which side of a contour they passed is what rays near one know of the pose; some of the others tell what is wrong with it as a whole.
void choose_rays(const Mission& mission, const Pose& T_target_sensor, double near_m, Workspace& workspace) {
  const View<N> view = make_view(mission, T_target_sensor);
  find_contour(mission, view, workspace);
  find_rays_near_contour(view, N::to_length(near_m), workspace);
  const Vec3 center = inverse(T_target_sensor) * mission.center_m;
  const auto place_of = [&](std::size_t i) {
    const ScanRay<N>& ray = workspace.rays[i];
    if (!is_near(center, kReach * mission.radius_m, ray)) return RayPlace::kAside;
    return workspace.near_contour[i] ? RayPlace::kNearContour : RayPlace::kElsewhere;
  };
  std::size_t counts[3] = {};
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) ++counts[static_cast<std::size_t>(place_of(i))];
  Choice near(counts[static_cast<std::size_t>(RayPlace::kNearContour)], kNearRays);
  Choice others(counts[static_cast<std::size_t>(RayPlace::kElsewhere)], kOutlineRays - kNearRays);
  workspace.outline.clear();
  for (std::size_t i = 0; i < workspace.rays.size(); ++i) {
    const RayPlace place = place_of(i);
    if (place == RayPlace::kAside || !(place == RayPlace::kNearContour ? near : others).takes_next()) continue;
    (void)workspace.outline.push_back({static_cast<std::uint16_t>(i)});
  }
}

// Gaps beyond which an answer is one higher.
struct Gaps {
  N::Length at[kDisputed];
};

Gaps gaps_of(const OutlineCare& care) {
  Gaps gaps{};
  for (std::uint32_t k = 0; k < kQuarters; ++k) gaps.at[k] = N::to_length(kCostSigmas * care.sigma_m * square_root((k + 1.0) / kQuarters));
  gaps.at[kQuarters] = N::to_length(care.edge_depth_m + kGateSigmas * care.sigma_m);
  return gaps;
}

std::uint8_t answer_of(const Mission& mission, const PathPose<N>& pose, const Gaps& gaps, const ScanRay<N>& ray) {
  const FieldHit<N> met = meet_model(mission, pose, ray);
  if (ray.state == RayState::kMiss) return met.found ? kDisputed : 0;
  if (!met.found) return kDisputed;
  const N::Length gap = met.t - ray.range;
  std::uint8_t answer = 0;
  while (answer < kDisputed && (gap > gaps.at[answer] || -gap > gaps.at[answer])) ++answer;
  return answer;
}

class Slide {
 public:
  Slide(const Mission& mission, const Directions& directions, const OutlineCare& care, Workspace& workspace)
      : mission_(mission), directions_(directions), care_(care), gaps_(gaps_of(care)), workspace_(workspace) {}

  OutlineFit take(const Pose& start) {
    best_ = start;
    reopen();
    const Count before = count_;
    descend();
    if (!is_open_) reopen();
    const bool moves = count_.cost + kFewRays * kQuarters <= before.cost && count_.disputed + kFewRays <= before.disputed;
    if (!moves && has_moved_) stay_at(start);
    const std::uint32_t most_asked = asked_ + care_.measured;
    for (int i = 0; i < directions_.count; ++i) measure(i, most_asked);
    return describe(moves);
  }

 private:
  void descend() {
    double step_m = care_.first_step * mission_.radius_m;
    for (int round = 0; round < kOutlineRounds && may_step(step_m); ++round) {
      if (moved_m_ + step_m > closed_within_m_) reopen();
      const bool helps = try_all(step_m);
      if (!helps && is_open_ && asked_ < care_.asked) close_certain(step_m);
      step_m = next_step(step_m, helps);
    }
  }

  bool may_step(double step_m) const { return step_m >= care_.last_step * mission_.radius_m && asked_ < care_.asked; }

  double next_step(double step_m, bool helps) const {
    if (!helps) return 0.5 * step_m;
    return is_open_ && may_double(step_m) ? 2 * step_m : step_m;
  }

  bool may_double(double step_m) const { return 2 * step_m < kLongestStep * mission_.radius_m; }

  bool try_all(double step_m) {
    bool helps = false;
    for (int i = 0; i < directions_.count && asked_ < care_.asked; ++i) {
      if (try_both_ways(i, step_m)) helps = true;
    }
    return helps;
  }

  Pose beside(int i, double way_m) const {
    return step_pose(best_, directions_.vectors.col(i).cwiseQuotient(radius_scale(mission_.radius_m)) * way_m);
  }

  bool try_both_ways(int i, double step_m) {
    const Count forth = try_pose(beside(i, step_m));
    if (forth.cost + kQuarters <= count_.cost) return move_by(step_m, beside(i, step_m), forth);
    const Count back = try_pose(beside(i, -step_m));
    if (back.cost + kQuarters <= count_.cost) return move_by(step_m, beside(i, -step_m), back);
    if (is_disputed_more(forth) && is_disputed_more(back)) within_m_[i] = step_m;
    return false;
  }

  bool is_disputed_more(const Count& count) const { return count.disputed >= count_.disputed + kFewRays; }

  Count try_pose(const Pose& pose) {
    const PathPose<N> path = to_path<N>(pose);
    Count count;
    for (OutlineRay& ray : workspace_.outline) {
      ray.tried = ray.open ? ask(path, ray) : ray.best;
      ray.doubtful = ray.doubtful || ray.tried != ray.best;
      count.add(ray.tried);
    }
    return count;
  }

  std::uint8_t ask(const PathPose<N>& pose, const OutlineRay& ray) {
    ++asked_;
    return answer_of(mission_, pose, gaps_, workspace_.rays[ray.ray]);
  }

  // To the pose that was tried last.
  bool move_by(double step_m, const Pose& pose, const Count& count) {
    for (OutlineRay& ray : workspace_.outline) ray.best = ray.tried;
    best_ = pose;
    count_ = count;
    moved_m_ += step_m;
    has_moved_ = true;
    return true;
  }

  // Rays on which no step so long answered otherwise are taken to answer alike within as much. Behind a part thinner than the step that may
  // be wrong: what the pose costs in the end, and what it is worth, all of them are asked.
  void close_certain(double step_m) {
    for (OutlineRay& ray : workspace_.outline) ray.open = ray.doubtful;
    is_open_ = false;
    closed_within_m_ = step_m;
    moved_m_ = 0;
  }

  // Asks all of the best pose.
  void reopen() {
    for (OutlineRay& ray : workspace_.outline) ray.open = true;
    count_ = try_pose(best_);
    for (OutlineRay& ray : workspace_.outline) {
      ray.best = ray.tried;
      ray.doubtful = false;
    }
    is_open_ = true;
    closed_within_m_ = kNever_m;
  }

  void stay_at(const Pose& start) {
    best_ = start;
    reopen();
  }

  // A step after which more rays dispute the pose, either way, as found on the way to it, is measured at the pose itself.
  void measure(int i, std::uint32_t most_asked) {
    while (within_m_[i] > 0 && !holds(i)) within_m_[i] = asked_ < most_asked ? longer(within_m_[i]) : 0;
  }

  bool holds(int i) { return is_disputed_more(try_pose(beside(i, within_m_[i]))) && is_disputed_more(try_pose(beside(i, -within_m_[i]))); }

  double longer(double step_m) const { return may_double(step_m) ? 2 * step_m : 0; }

  OutlineFit describe(bool moved) const {
    OutlineFit fit;
    fit.T_target_sensor = best_;
    fit.moved = moved;
    fit.asked = asked_;
    fit.rays = static_cast<std::uint32_t>(workspace_.outline.size());
    fit.disputed = count_.disputed;
    for (const OutlineRay& ray : workspace_.outline) fit.hits += workspace_.rays[ray.ray].state == RayState::kHit ? 1u : 0u;
    const double dropout = mission_.parameters.dropout_probability;  // of the rays on the target, of which the hits are the rest
    fit.settled = fit.disputed <= kDisputedShare * fit.rays + dropout / (1 - dropout) * fit.hits + kFewRays;
    if (fit.settled) fit.within_m = within_m_;
    return fit;
  }

  const Mission& mission_;
  const Directions& directions_;
  const OutlineCare& care_;
  Gaps gaps_;
  Workspace& workspace_;
  Pose best_;
  Count count_;  // of the best pose
  bool has_moved_ = false;
  bool is_open_ = true;
  double closed_within_m_ = 0;  // rays that are closed answer as they did, within so far from where they were closed
  double moved_m_ = 0;          // since then
  std::uint32_t asked_ = 0;
  Vec6 within_m_ = Vec6::Zero();
};

}  // namespace

OutlineFit fit_outline(const Mission& mission, const Pose& T_target_sensor, const Directions& directions, const OutlineCare& care,
                       Workspace& workspace) {
  choose_rays(mission, T_target_sensor, kNear * care.first_step * mission.radius_m, workspace);
  return Slide(mission, directions, care, workspace).take(T_target_sensor);
}

}  // namespace lasso
