#include <cmath>
#include <limits>
#include <optional>

#include "fsw/sense/range_image.hpp"
#include "mdat/run/case.hpp"
#include "mdat/serve/answers.hpp"
#include "mdat/serve/bits.hpp"
#include "mdat/serve/iterations.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kScanColumns = 9;

struct ScanPoint {
  float x = kAbsent, y = kAbsent, z = kAbsent, residual_m = kAbsent, sigma_m = kAbsent, range_m = kAbsent, age_s = 0, state = 0, part = -1;
};

// The fields of a cloud that mean something here, by the names that are usual.
struct ScanFields {
  explicit ScanFields(const CloudView& cloud)
      : x(cloud.field("x")),
        y(cloud.field("y")),
        z(cloud.field("z")),
        ux(cloud.field("ux")),
        uy(cloud.field("uy")),
        uz(cloud.field("uz")),
        range(cloud.field("range")),
        sigma(cloud.field("sigma")),
        residual(cloud.field("residual")),
        offset_us(cloud.field("offset_us")),
        state(cloud.field("state")) {}
  const CloudView::Field *x, *y, *z, *ux, *uy, *uz, *range, *sigma, *residual, *offset_us, *state;
};

struct ScanSetting {
  double miss_range_m = 0;  // at which rays that met nothing are shown
  float part = -1;
};

// A ray that met nothing is where it passes the target.
void place_miss(const CloudView& cloud, std::size_t i, const ScanFields& fields, double range_m, ScanPoint& point) {
  const auto range = static_cast<float>(range_m);
  point.x = range * cloud.value(i, fields.ux);
  point.y = range * cloud.value(i, fields.uy);
  point.z = range * cloud.value(i, fields.uz);
  point.range_m = kAbsent;
  point.residual_m = kAbsent;
}

ScanPoint point_of(const CloudView& cloud, std::size_t i, const ScanFields& fields, const ScanSetting& setting) {
  ScanPoint point;
  point.x = cloud.value(i, fields.x);
  point.y = cloud.value(i, fields.y);
  point.z = cloud.value(i, fields.z);
  point.residual_m = cloud.value(i, fields.residual);
  point.range_m =
      fields.range != nullptr ? cloud.value(i, fields.range) : std::sqrt(point.x * point.x + point.y * point.y + point.z * point.z);
  point.age_s = fields.offset_us != nullptr ? 1e-6F * cloud.value(i, fields.offset_us) : 0;
  point.part = setting.part;
  if (fields.state != nullptr) point.state = cloud.value(i, fields.state);
  if (point.state != static_cast<float>(RayState::kHit)) {
    place_miss(cloud, i, fields, setting.miss_range_m, point);
    return point;
  }
  point.sigma_m = cloud.value(i, fields.sigma);
  return point;
}

std::string scan_bytes(const std::vector<ScanPoint>& points) {
  std::string bytes;
  mcap::put(static_cast<std::uint32_t>(points.size()), bytes);
  mcap::put(kScanColumns, bytes);
  for (float ScanPoint::*column : {&ScanPoint::x, &ScanPoint::y, &ScanPoint::z, &ScanPoint::residual_m, &ScanPoint::sigma_m,
                                   &ScanPoint::range_m, &ScanPoint::age_s, &ScanPoint::state, &ScanPoint::part}) {
    for (const ScanPoint& point : points) mcap::put(point.*column, bytes);
  }
  return bytes;
}

// Residuals at the pose of an iteration; its rates are those of the frame before, with which the registration moved the rays.
void put_iteration(const Shown& shown, std::size_t n, std::size_t iteration, std::vector<ScanPoint>& points) {
  const std::vector<RegistrationStep> iterations = iterations_of(*shown.recording, n);
  const std::optional<RangeImage> scan = recorded_scan(*shown.recording, n);
  const std::optional<PoseTelemetry> before = n > 0 ? shown.recording->told(n - 1) : std::nullopt;
  if (iteration >= iterations.size() || !scan || !before)
    throw Refusal{404, "there is no iteration " + std::to_string(iteration), "this frame has " + std::to_string(iterations.size())};
  const Twist rates{Vec3(before->filter_omega_radps), Vec3(before->filter_v_mps)};
  const std::vector<float> residuals = residuals_at(*shown.recording, *scan, iterations[iteration].T_sensor_target, rates);
  for (std::size_t i = 0; i < std::min(points.size(), residuals.size()); ++i) points[i].residual_m = residuals[i];
}

}  // namespace

// Of another program's clouds residual and sigma are absent, and every point is a return. A frame whose scan was lost has no points.
Response scan_answer(const Shown& shown, std::size_t n, const Target& target) {
  const Recording& recording = *shown.recording;
  const std::string message = recording.message(n, recording.cloud_topic());
  const std::optional<CloudView> cloud = message.empty() ? std::nullopt : read_cloud(message);
  if (!cloud) return binary_response(scan_bytes({}));
  ScanSetting setting;
  const std::optional<PoseTelemetry> told = recording.told(n);
  if (told) {
    setting.miss_range_m = registration_pose(*told).p.norm();
    setting.part = told->part;
  }
  const ScanFields fields(*cloud);
  std::vector<ScanPoint> points;
  for (std::size_t i = 0; i < cloud->size(); ++i) points.push_back(point_of(*cloud, i, fields, setting));
  if (!text_in(target, "iteration").empty()) put_iteration(shown, n, count_in(target, "iteration", 0, 1000), points);
  return binary_response(scan_bytes(points));
}

}  // namespace lasso::mdat::serve
