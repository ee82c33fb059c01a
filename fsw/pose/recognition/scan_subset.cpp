#include "fsw/pose/recognition/scan_subset.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/work_units.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr int kBins = 16;                   // across the scan, each way
constexpr float kNeighbourShare = 0.08F;    // of the model's size: a return has company this near
constexpr float kNeighbourSpacings = 2.2F;  // and within this many times the spacing of rays
constexpr std::size_t kCompany = 2;         // or it is an outlier
constexpr float kNoiseReach = 3;            // sigmas
constexpr int kHalvings = 12;               // of the depths that the median may have

// The search is no part of the path that each scan takes: it has floating point in every build.
float squared_distance(const N::Length* a, const N::Length* b) {
  const float d[3] = {N::to_float(a[0] - b[0]), N::to_float(a[1] - b[1]), N::to_float(a[2] - b[2])};
  return dot3<FloatNumber>(d, d);
}

float squared_range(const N::Length* p) {
  const float d[3] = {N::to_float(p[0]), N::to_float(p[1]), N::to_float(p[2])};
  return dot3<FloatNumber>(d, d);
}

float root(float x) { return static_cast<float>(square_root(static_cast<double>(x))); }

// How many rays of the scan go into each part of the field of view: a pattern is denser here than there.
class RayDensity {
 public:
  explicit RayDensity(const Workspace& workspace) {
    for (const ScanRay<N>& ray : workspace.rays) widen(ray.u);
    for (int i = 0; i < 2; ++i) bins_per_unit_[i] = high_[i] > low_[i] ? static_cast<float>(kBins) / (high_[i] - low_[i]) : 0;
    for (const ScanRay<N>& ray : workspace.rays) ++count_[bin_of(ray.u)];
  }
  std::uint16_t at(const N::Unit* u) const { return count_[bin_of(u)]; }
  // Typical angle between neighbouring rays, were they spread evenly.
  float spacing(std::size_t rays) const {
    const double area = static_cast<double>((high_[0] - low_[0]) * (high_[1] - low_[1]));
    return static_cast<float>(square_root(area / static_cast<double>(rays)));
  }

 private:
  // Sensors look along z: directions beside it are taken on the plane z = 1, those farther than 63 deg off at its rim.
  static float tangent(const N::Unit* u, int i) {
    const float z = N::to_float(u[2]);
    return N::to_float(u[i]) / (z > 0.45F ? z : 0.45F);
  }
  void widen(const N::Unit* u) {
    for (int i = 0; i < 2; ++i) {
      const float t = tangent(u, i);
      if (t < low_[i]) low_[i] = t;
      if (t > high_[i]) high_[i] = t;
    }
  }
  std::size_t bin_of(const N::Unit* u) const {
    std::size_t bin = 0;
    for (int i = 0; i < 2; ++i) {
      const auto place = static_cast<std::int32_t>((tangent(u, i) - low_[i]) * bins_per_unit_[i]);
      bin = bin * kBins + static_cast<std::size_t>(place < kBins ? place : kBins - 1);
    }
    return bin;
  }

  float low_[2] = {10, 10}, high_[2] = {-10, -10}, bins_per_unit_[2] = {};
  std::uint16_t count_[kBins * kBins] = {};
};

}  // namespace

void put_points(const ScanSubset& subset, std::size_t count, Workspace& workspace) {
  workspace.points.clear();
  for (std::size_t i = 0; i < subset.hits.size() && i < count; ++i) {
    invariant(workspace.points.push_back(subset.hits[i]), "as many points as rays");
  }
}

void ScanSubsetMaker::begin(const Mission& mission, const Workspace& workspace) {
  const RayDensity density(workspace);
  const float spacing = density.spacing(workspace.rays.size());
  const float largest = kNeighbourShare * mission.search.size_m;
  const std::size_t misses = workspace.rays.size() - workspace.points.size();
  hit_stride_ = (workspace.points.size() + kPoolRays - 1) / kPoolRays;
  miss_stride_ = (misses + kPoolRays - 1) / kPoolRays;
  hits_.clear();
  misses_.clear();
  judged_ = 0;
  for (std::size_t i = 0; i < workspace.points.size(); i += hit_stride_) {
    const MatchPoint<N>& point = workspace.points[i];
    const float area = squared_range(point.p) / static_cast<float>(density.at(point.u));
    const float range = root(squared_range(point.p));
    const float reach = kNeighbourSpacings * range * spacing;
    invariant(hits_.push_back({point, area, 1e12F, reach < largest ? reach : largest, 0, false}), "a pool of returns");
  }
  std::size_t index = 0;
  for (const ScanRay<N>& ray : workspace.rays) {
    if (ray.state == RayState::kMiss && index++ % miss_stride_ == 0) invariant(misses_.push_back(ray), "a pool of misses");
  }
}

bool ScanSubsetMaker::step(const Mission& mission, ScanSubset& subset, std::uint32_t& work) {
  if (judged_ < hits_.size()) {
    work += company_work(judge_isolation(judged_++));
    if (judged_ == hits_.size()) drop_isolated();
    return true;
  }
  if (subset.hits.empty()) {
    subset.returns = static_cast<std::uint32_t>(hits_.size() * hit_stride_);
    find_centroid(subset);
    work += middle_work(hits_.size());
  }
  if (subset.hits.size() < hits_.size() && !subset.hits.full()) {
    choose(subset);
    work += choice_work(hits_.size());
    return true;
  }
  choose_misses(mission, subset);
  work += passing_work(misses_.size());
  return false;
}

// Answers how many others it looked at.
std::size_t ScanSubsetMaker::judge_isolation(std::size_t index) {
  const float reach = hits_[index].reach;
  std::size_t company = 0;
  // Neighbours in time are near, mostly: the search begins with them.
  std::size_t k = 1;
  for (; k < hits_.size() && company < kCompany; ++k) {
    const std::size_t other = index + k < hits_.size() ? index + k : index + k - hits_.size();
    if (squared_distance(hits_[index].point.p, hits_[other].point.p) < reach * reach) ++company;
  }
  hits_[index].kept = company >= kCompany;
  return k;
}

void ScanSubsetMaker::drop_isolated() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    if (hits_[i].kept) hits_[kept++] = hits_[i];
  }
  hits_.shrink(kept);
  judged_ = kept;
}

void ScanSubsetMaker::find_centroid(ScanSubset& subset) const {
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (const PoolHit& hit : hits_) {
    const double weight = static_cast<double>(hit.weight);
    for (int i = 0; i < 3; ++i) sum[i] += weight * N::to_double(hit.point.p[i]);
    weights += weight;
  }
  if (!(weights > 0)) return;
  subset.centroid = sum / weights;
  find_median(weights, subset);
}

// By halving the depths that it may have.
void ScanSubsetMaker::find_median(double weights, ScanSubset& subset) const {
  const double range = square_root(subset.centroid.squaredNorm());
  double low = 0;
  double high = 2 * range;
  for (int k = 0; k < kHalvings; ++k) {
    const double depth = 0.5 * (low + high);
    double below = 0;
    for (const PoolHit& hit : hits_) {
      double along = 0;
      for (int i = 0; i < 3; ++i) along += subset.centroid[i] * N::to_double(hit.point.p[i]);
      if (along < depth * range) below += static_cast<double>(hit.weight);
    }
    (2 * below < weights ? low : high) = depth;
  }
  subset.median = 0.5 * (low + high) - range;
}

// The return that is farthest from all that were chosen; the pool's first one to begin with.
void ScanSubsetMaker::choose(ScanSubset& subset) {
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < hits_.size(); ++i) {
    if (hits_[i].distance2 > hits_[farthest].distance2) farthest = i;
  }
  const MatchPoint<N>& chosen = hits_[farthest].point;
  const ReturnReach reach{N::from_float<N::Length>(root(squared_range(chosen.p))), kNoiseReach * root(N::to_float(chosen.range_variance))};
  invariant(subset.hits.push_back(chosen), "room for a return");
  invariant(subset.reaches.push_back(reach), "as many as returns");
  const std::size_t region = subset.hits.size() - 1;
  for (PoolHit& hit : hits_) {
    const float distance2 = squared_distance(hit.point.p, chosen.p);
    if (!(distance2 < hit.distance2)) continue;
    hit.distance2 = distance2;
    if (region < kRegions) hit.region = static_cast<std::uint8_t>(region);
  }
  invariant(subset.regions.push_back(hits_[farthest].region), "as many as returns");
}

// Misses that pass the target's middle within its radius; others say little.
void ScanSubsetMaker::choose_misses(const Mission& mission, ScanSubset& subset) const {
  const double limit = mission.radius_m * mission.radius_m;
  const auto passes_by = [&](const ScanRay<N>& ray) {
    const Vec3 u(N::to_double(ray.u[0]), N::to_double(ray.u[1]), N::to_double(ray.u[2]));
    return subset.centroid.cross(u).squaredNorm() < limit;
  };
  std::size_t count = 0;
  for (const ScanRay<N>& ray : misses_) count += passes_by(ray) ? 1u : 0u;
  const std::size_t stride = count / kSubsetMisses + 1;
  std::size_t index = 0;
  for (const ScanRay<N>& ray : misses_) {
    if (passes_by(ray) && index++ % stride == 0) invariant(subset.misses.push_back(ray), "room for a miss");
  }
  if (subset.hits.empty()) return;
  const double per_hit = static_cast<double>(hits_.size() * hit_stride_) / static_cast<double>(subset.hits.size());
  subset.misses_per_hit = static_cast<double>(stride * miss_stride_) / per_hit;
}

}  // namespace lasso
