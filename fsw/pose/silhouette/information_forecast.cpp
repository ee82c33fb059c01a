#include "fsw/pose/silhouette/information_forecast.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/model_ray.hpp"
#include "fsw/pose/silhouette/contour_probe.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;

double square(double x) { return x * x; }

void include(const ImagePoint& point, ScanRectangle& rectangle) {
  const float at[2] = {N::to_float(point.x), N::to_float(point.y)};
  for (int i = 0; i < 2; ++i) {
    if (at[i] < rectangle.low[i]) rectangle.low[i] = at[i];
    if (at[i] > rectangle.high[i]) rectangle.high[i] = at[i];
  }
}

// A ray from the sensor, whose pose is `pose`.
SeenPoint see(const Mission& mission, const PathPose<N>& pose, const ScanRay<N>& ray) {
  SeenPoint seen;
  const Field<N>& field = mission.field;
  const FieldHit<N> hit = meet_model(mission, pose, ray);
  if (!hit.found) return seen;
  seen.met = true;
  N::Unit u[3];
  rotate(pose, ray.u, u);
  const Length q[3] = {pose.t[0] + hit.t * u[0], pose.t[1] + hit.t * u[1], pose.t[2] + hit.t * u[2]};
  N::Unit normal[3];
  surface_normal(field, field.elements[hit.element], q, normal);
  const auto facing = cut<N::Unit>(dot3<N>(normal, u));
  const MissionParameters& p = mission.parameters;
  const double tilt2 = square(N::to_double(facing));
  if (tilt2 < square(sin_cos(p.incidence_max_rad).cos)) return seen;
  const double range_m = N::to_double(hit.t);
  const double across = clamp(1 - tilt2, 0.0, 1.0);  // a curved surface's normal may be longer than 1
  const double variance = tilt2 * range_variance(p, range_m) + across * square(range_m * p.sigma_angle_rad) + square(p.surface_sigma_m);
  const Vec3 n = to_vec3(normal);
  seen.point = to_vec3(q);
  seen.row << seen.point.cross(n), n;
  seen.weight = 1 / variance;
  return seen;
}

}  // namespace

double range_variance(const MissionParameters& parameters, double range_m) {
  return square(parameters.sigma0_m) + square(parameters.sigma_k_per_m * range_m * range_m);
}

ScanRectangle outline_of(const Mission& mission, const View<N>& view) {
  ScanRectangle outline;
  for (const HullPointOf<N>& point : mission.hull) {
    const ImagePoint seen = project(view.pose, point.p);
    if (seen.z > Length{0}) include(seen, outline);
  }
  return outline;
}

ScanRectangle visible_outline(const Mission& mission, const View<N>& view) {
  ScanRectangle outline = outline_of(mission, view);
  const float limit[2] = {static_cast<float>(tangent(mission.parameters.fov_half_x_rad)),
                          static_cast<float>(tangent(mission.parameters.fov_half_y_rad))};
  for (int i = 0; i < 2; ++i) {
    if (outline.low[i] < -limit[i]) outline.low[i] = -limit[i];
    if (outline.high[i] > limit[i]) outline.high[i] = limit[i];
  }
  return outline;
}

SeenPoint look_at(const Mission& mission, const View<N>& view, const ScanRectangle& r, int index) {
  const int row = index / kForecastColumns;
  const int column = index % kForecastColumns;
  const double x = static_cast<double>(r.low[0]) + (column + 0.5) / kForecastColumns * static_cast<double>(r.high[0] - r.low[0]);
  const double y = static_cast<double>(r.low[1]) + (row + 0.5) / kForecastRows * static_cast<double>(r.high[1] - r.low[1]);
  const double scale = 1 / square_root(x * x + y * y + 1);
  ScanRay<N> ray{};
  for (int i = 0; i < 2; ++i) ray.u[i] = N::to<N::Unit>((i == 0 ? x : y) * scale);
  ray.u[2] = N::to<N::Unit>(scale);
  return see(mission, view.pose, ray);
}

InformationForecast forecast_information(const Mission& mission, const View<N>& view, const ScanRectangle& rectangle, double rays) {
  InformationForecast forecast;
  for (int i = 0; i < kForecastRays; ++i) {
    const SeenPoint seen = look_at(mission, view, rectangle, i);
    forecast.met += seen.met ? 1 : 0;
    forecast.information += seen.weight * seen.row * seen.row.transpose();
  }
  forecast.information = (rays / kForecastRays) * forecast.information;
  return forecast;
}

}  // namespace lasso
