#include "mdat/serve/iterations.hpp"

#include <memory>

#include "hal_sim/ray_caster.hpp"
#include "mdat/recording/scan_cloud.hpp"

namespace lasso::mdat::serve {
namespace {

std::unique_ptr<sim::RayCaster> caster_of(const SurfaceTriangles& surface) {
  std::vector<Vec3> points;
  for (const auto& point : surface.points)
    points.emplace_back(static_cast<double>(point[0]), static_cast<double>(point[1]), static_cast<double>(point[2]));
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    const std::array<std::uint32_t, 3> corners = {surface.indices[i], surface.indices[i + 1], surface.indices[i + 2]};
    const Vec3& a = points[corners[0]];
    const Vec3 normal = (points[corners[1]] - a).cross(points[corners[2]] - a);
    if (normal.squaredNorm() > 0) triangles.push_back(corners);
  }
  return triangles.empty() ? nullptr : sim::make_ray_caster(points, triangles);
}

}  // namespace

std::optional<RangeImage> recorded_scan(const Recording& recording, std::size_t n) {
  const std::string message = recording.own() ? recording.message(n, "/scan") : "";
  const std::optional<CloudView> cloud = message.empty() ? std::nullopt : read_cloud(message);
  std::vector<RangeSample> samples;
  const auto t_us = static_cast<TimeUs>(recording.frames().at(n).time_ns / 1000);
  RangeImage scan;
  if (!cloud || !samples_of({{}, cloud->step, std::string(cloud->data)}, t_us, samples) || !to_range_image(samples, scan))
    return std::nullopt;
  return scan;
}

std::vector<RegistrationStep> iterations_of(const Recording& recording, std::size_t n) {
  const std::optional<PoseTelemetry> told = recording.told(n), before = n > 0 ? recording.told(n - 1) : std::nullopt;
  if (!told || !before || recording.image() == nullptr) return {};
  const std::optional<RangeImage> scan = recorded_scan(recording, n);
  return scan ? registration_steps(*recording.image(), *before, *told, *scan) : std::vector<RegistrationStep>();
}

std::vector<float> residuals_at(const Recording& recording, const RangeImage& scan, const Pose& T_sensor_target, const Twist& rates) {
  const std::optional<SurfaceTriangles> surface = read_surface(recording.first_message("/scene"));
  const std::unique_ptr<sim::RayCaster> caster = surface ? caster_of(*surface) : nullptr;
  if (!caster) return {};
  const std::vector<RangeSample> samples(scan.samples.begin(), scan.samples.end());
  return residuals_of({samples, scan.reference_time_us(), T_sensor_target, rates}, *caster);
}

}  // namespace lasso::mdat::serve
