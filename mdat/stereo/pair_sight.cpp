#include "mdat/stereo/pair_sight.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "mdat/render/render.hpp"
#include "mdat/stereo/disparity_errors.hpp"
#include "mdat/stereo/exposure_control.hpp"

namespace lasso::mdat {
namespace {

constexpr int kGrid = 64;  // pixels of the exposure's grid along a side
constexpr double kFirstExposure_s = 1e-3, kSettledWithin = 0.01;
constexpr int kMostExposures = 16;
constexpr double kClearOf = 1e-4;  // of a range: so far off the surface a ray to the right camera starts
// As the matcher's mask of light has it (mdat/match/masks.hpp): means over 5 x 5 pixels, and what is within 4 pixels of a dark one. The
// dark window's nearer side is then kMaskNear_px away, and its farther one about kEdgeBand_px.
constexpr double kDark_e = 20, kMaskNear_px = 2.5;
constexpr int kAround[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};

}  // namespace

struct PairSight::Seen {
  bool hit = false;
  Vec3 point_m = Vec3::Zero();  // left camera's axes
  double radiance = 0;          // of the band
};

PairSight::PairSight(const StereoHead& head, const StereoView& view)
    : head_(head),
      view_(view),
      T_target_sensor_(inverse(view.T_sensor_target)),
      shader_(view.surface, view.materials, lights_in_frame(view.lights, T_target_sensor_)),
      electrons_(electrons_per_radiance(head.imager)) {
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i)
      grid_.push_back(seen_at((i + 0.5) / kGrid * head_.camera.width, (j + 0.5) / kGrid * head_.camera.height).radiance);
  }
}

PairSight::Seen PairSight::seen_at(double column, double row) const {
  const Vec3 direction = head_.camera.direction(column, row);
  const auto pixel = static_cast<std::uint64_t>(std::max(0.0, row * head_.camera.width + column));
  const PictureRay ray{T_target_sensor_.p, rotate(T_target_sensor_.q, direction), 1 / head_.camera.focal_px, PixelSamples(pixel, 1), 0};
  SurfacePoint found;
  Rgb radiance;
  if (!shader_.radiance(ray, found, radiance)) return {};
  return {true, found.range_m * direction, kBandShare * radiance.mean()};
}

double PairSight::disparity_of(double column, const Vec3& point_m) const {
  const Vec3 in_right = inverse(head_.T_left_right) * point_m;
  return column - (head_.camera.center_x + head_.camera.focal_px * in_right.x() / in_right.z());
}

bool PairSight::is_hidden(const Vec3& point_m) const {
  const Vec3 way = point_m - head_.T_left_right.p;
  SurfacePoint found;
  const bool hit = view_.surface.find(T_target_sensor_ * head_.T_left_right.p, rotate(T_target_sensor_.q, way.normalized()), found);
  return hit && found.range_m < (1 - kClearOf) * way.norm() - kClearOf;
}

double PairSight::electrons_of(const Seen& seen, double exposure_s) const {
  return std::min(head_.imager.full_well_e, seen.radiance * electrons_ * exposure_s);
}

RawFrame PairSight::grid_frame(double exposure_s) const {
  RawFrame frame{kGrid, kGrid, exposure_s, {}};
  const int greatest = greatest_number(head_.imager);
  for (const double radiance : grid_) {
    const double share = std::min(1.0, radiance * electrons_ * exposure_s / head_.imager.full_well_e);
    frame.numbers.push_back(static_cast<std::uint16_t>(std::lround(share * greatest)));
  }
  return frame;
}

double PairSight::next_exposure_s(double exposure_s) const { return mdat::next_exposure_s(grid_frame(exposure_s), head_.imager); }

double PairSight::settled_exposure_s() const {
  double exposure_s = kFirstExposure_s;
  for (int i = 0; i < kMostExposures; ++i) {
    const double next_s = next_exposure_s(exposure_s);
    const bool settled = std::fabs(next_s - exposure_s) <= kSettledWithin * exposure_s;
    exposure_s = next_s;
    if (settled) break;
  }
  return exposure_s;
}

PixelSight PairSight::at(int column, int row, double exposure_s) const {
  const Seen seen = seen_at(column, row);
  PixelSight sight;
  if (seen.hit) sight.disparity_px = sight.nearer_px = disparity_of(column, seen.point_m);
  double least_px = sight.disparity_px;
  const double own_e = electrons_of(seen, exposure_s);
  sight.dark = own_e < kDark_e;
  for (const auto& [right, down] : kAround) {
    const double u = column + kEdgeBand_px * right, v = row + kEdgeBand_px * down;
    const Seen beside = seen_at(u, v);
    const double disparity_px = beside.hit ? disparity_of(u, beside.point_m) : 0;
    sight.nearer_px = std::max(sight.nearer_px, disparity_px);
    least_px = std::min(least_px, disparity_px);
    if (sight.dark || electrons_of(beside, exposure_s) >= kDark_e) continue;
    sight.dark = electrons_of(seen_at(column + kMaskNear_px * right, row + kMaskNear_px * down), exposure_s) < kDark_e;
  }
  sight.level = std::sqrt(own_e / head_.imager.full_well_e);
  if (!seen.hit) {
    sight.region = sight.nearer_px > 0 ? PixelRegion::kSky : PixelRegion::kEmpty;
  } else if (is_hidden(seen.point_m)) {
    sight.region = PixelRegion::kHidden;
  } else if (sight.nearer_px > (1 + kEdgeStep) * sight.disparity_px) {
    sight.region = PixelRegion::kFarEdge;
  } else if (sight.nearer_px > (1 + kEdgeStep) * least_px) {
    sight.region = PixelRegion::kNearEdge;
  } else {
    sight.region = PixelRegion::kInside;
  }
  return sight;
}

}  // namespace lasso::mdat
