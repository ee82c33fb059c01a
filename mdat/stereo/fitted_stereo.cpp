#include "mdat/stereo/fitted_stereo.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "mdat/stereo/error_field.hpp"

namespace lasso::mdat {
namespace {

enum FieldPurpose : std::uint64_t { kNearErrors = 1, kPartErrors = 2, kViewErrors = 3, kFoundAtAll = 4, kSpreadOver = 5 };
constexpr double kFoundBlur_px = 4;  // holes are as wide as the matcher's windows

std::uint64_t field_seed(std::uint64_t seed, std::uint64_t purpose, std::uint64_t number) {
  return seed * 0xD1342543DE82EF95U ^ (purpose << 56) ^ (number * 0x2545F4914F6CDD1DU);
}

RangeSample nothing_along(const Vec3& direction, TimeUs t_us) {
  RangeSample sample;
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(direction[axis]);
  sample.t_us = t_us;
  return sample;
}

}  // namespace

FittedStereo::FittedStereo(StereoHead head, std::uint64_t seed, const StereoFit& fit, const FittedCommon& common)
    : head_(std::move(head)), seed_(seed), fit_(fit), common_(common) {}

void FittedStereo::take(const StereoView& view, const MatchDepths& depths) {
  sight_ = std::make_unique<PairSight>(head_, view);
  depths_ = depths;
  exposure_s_ = head_.source.exposure_s;
  if (exposure_s_ == 0) exposure_s_ = next_exposure_s_ > 0 ? next_exposure_s_ : sight_->settled_exposure_s();
  next_exposure_s_ = sight_->next_exposure_s(exposure_s_);
  if (attitude_) turned_rad_ += attitude_->angularDistance(view.T_sensor_target.q);
  attitude_ = view.T_sensor_target.q;
  ++frame_;
}

// Mostly that of the frame before, as long as the view is: from one field to the next as the target turns, and a part of its own.
double FittedStereo::kept_field(std::uint64_t purpose, double column, double row, double blur_px) const {
  const double views = turned_rad_ / common_.view_rad, whole = std::floor(views);
  const double turn = 0.5 * kPi * (views - whole);
  const auto number = static_cast<std::uint64_t>(whole);
  const auto field = [&](std::uint64_t of, std::uint64_t n) { return error_field(field_seed(seed_, of, n), column, row, blur_px); };
  const double kept = std::cos(turn) * field(purpose, 2 * number) + std::sin(turn) * field(purpose, 2 * number + 2);
  return std::sqrt(common_.kept_share) * kept + std::sqrt(1 - common_.kept_share) * field(purpose, 2 * frame_ + 1);
}

double FittedStereo::measured_px(const PixelSight& sight, int column, int row) const {
  if (sight.dark && sight.region != PixelRegion::kSky) return 0;  // sky is dark, and glare lights it
  const RegionFit& fit = fit_[static_cast<std::size_t>(sight.region)];
  if (normal_share(kept_field(kFoundAtAll, column, row, kFoundBlur_px)) >= fit.valid[fit_level(sight.level)]) return 0;
  const double near_share = 1 - common_.part_share - common_.view_share;
  const double common = std::sqrt(near_share) * kept_field(kNearErrors, column, row, common_.near_px) +
                        std::sqrt(common_.part_share) * kept_field(kPartErrors, column, row, common_.part_px) +
                        std::sqrt(common_.view_share) * kept_field(kViewErrors, 0, 0, 1);
  const bool spread = sight.region == PixelRegion::kSky || normal_share(kept_field(kSpreadOver, column, row, kFoundBlur_px)) < fit.spread;
  return (spread ? sight.nearer_px : sight.disparity_px) + fitted_error_px(fit, sight.level, normal_share(common));
}

RangeSample FittedStereo::sample(const Vec3& direction, TimeUs t_us) const {
  const Camera& camera = head_.camera;
  if (!(direction.z() > 0)) return nothing_along(direction, t_us);
  const Eigen::Vector2d at = camera.pixel(direction);
  const double u = std::floor(at.x() + 0.5), v = std::floor(at.y() + 0.5);
  if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) return nothing_along(direction, t_us);
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const PixelSight sight = sight_->at(column, row, exposure_s_);
  if (sight.region == PixelRegion::kEmpty) return nothing_along(direction, t_us);
  const double disparity_px = std::round(measured_px(sight, column, row) * kDisparitySteps) / kDisparitySteps;
  const double depth_px_m = camera.focal_px * head_.source.baseline_m;
  if (disparity_px * depths_.farthest_m < depth_px_m || disparity_px * depths_.nearest_m > depth_px_m)
    return nothing_along(direction, t_us);
  const Vec3 own = camera.direction(column, row);
  RangeSample sample = nothing_along(own, t_us);
  sample.range_m = static_cast<float>(depth_px_m / disparity_px / own.z());
  sample.state = RayState::kHit;
  return sample;
}

}  // namespace lasso::mdat
