#include "mdat/replay/single_scans.hpp"

#include "fsw/pose/recognition/pose_search.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint32_t kSlice = 100'000;  // units of work; the result does not depend on it

// Mean over the returns of the squared residual in sigmas; kUnexplainedCost of one that the pose does not explain.
double cost_of(const Registration& r) {
  return r.inlier_share * r.normalized_residual * r.normalized_residual + kUnexplainedCost * (1 - r.inlier_share);
}

}  // namespace

void SingleScans::search(const RangeImage& image, const Pose& T_sensor_target) {
  SearchLimits limits;
  limits.scans_max = 1;
  search_->begin(limits);
  search_->suspect(T_sensor_target);
  if (search_->add_scan(mission_, image, estimator_->workspace()) != Status::kOk) return;
  while (!search_->advance(mission_, estimator_->workspace(), kSlice)) {
  }
}

bool SingleScans::is_within_reach(const Pose& T_sensor_target, const StartPoint& start) const {
  const Vec6 off = pose_difference(T_sensor_target, start.T_sensor_target);
  const Vec3 middle_off = T_sensor_target * mission_.center_m - start.T_sensor_target * mission_.center_m;
  return off.head<3>().norm() <= kRoughStart_rad && middle_off.norm() <= kRoughStartShare * static_cast<double>(mission_.search.size_m);
}

Registration SingleScans::estimate(const RangeImage& image, const StartPoint& start) {
  Registration best = estimator_->estimate(mission_, image, start);
  if (!(mission_.parameters.start_check > 0.5)) return best;
  if (best.valid() && !is_within_reach(best.T_sensor_target, start)) best.reason = PoseReason::kFarFromStart;
  search(image, best.T_sensor_target);
  for (const SearchCandidate& candidate : search_->result().candidates) {
    if (!is_within_reach(candidate.T_sensor_target, start)) continue;
    const Registration other = estimator_->estimate(mission_, image, StartPoint{candidate.T_sensor_target, start.rates});
    if (!other.valid() || !is_within_reach(other.T_sensor_target, start)) continue;
    if (!best.valid() || cost_of(other) < cost_of(best)) best = other;
  }
  const bool is_sure = search_->result().outcome == SearchOutcome::kAccepted;
  const bool is_contradicted = best.valid() && is_sure && search_->contradicts(mission_, best.T_sensor_target, estimator_->workspace());
  if (is_contradicted) best.reason = PoseReason::kContradicted;
  return best;
}

}  // namespace lasso::mdat
