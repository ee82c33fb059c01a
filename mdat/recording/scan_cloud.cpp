#include "mdat/recording/scan_cloud.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "mdat/mcap/bytes.hpp"

namespace lasso::mdat {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

// One point of the scan as it lies in the message.
struct CloudPoint {
  float x = kNothing, y = kNothing, z = kNothing;
  float direction[3] = {};
  float range_m = 0, sigma_factor = 1, residual_m = kNothing;
  std::int32_t offset_us = 0;
  std::uint8_t state = 0, part = 0, unused[2] = {};
  float sigma_m = kNothing;
};
static_assert(sizeof(CloudPoint) == 48, "no padding");

const std::vector<ros::PointField>& cloud_fields() {
  static const std::vector<ros::PointField> kFields = {
      {"x", 0, ros::FieldType::kFloat32},         {"y", 4, ros::FieldType::kFloat32},
      {"z", 8, ros::FieldType::kFloat32},         {"ux", 12, ros::FieldType::kFloat32},
      {"uy", 16, ros::FieldType::kFloat32},       {"uz", 20, ros::FieldType::kFloat32},
      {"range", 24, ros::FieldType::kFloat32},    {"sigma_factor", 28, ros::FieldType::kFloat32},
      {"residual", 32, ros::FieldType::kFloat32}, {"offset_us", 36, ros::FieldType::kInt32},
      {"state", 40, ros::FieldType::kUint8},      {"part", 41, ros::FieldType::kUint8},
      {"sigma", 44, ros::FieldType::kFloat32}};
  return kFields;
}

// The target as it turns and moves during a scan: propagate (se3.hpp), for a thousand times of the same rates.
class MovingTarget {
 public:
  explicit MovingTarget(const ScanView& scan)
      : p_(scan.T_sensor_target.p),
        v_mps_(scan.rates.v_mps),
        speed_radps_(scan.rates.omega_radps.norm()),
        still_(to_matrix(scan.T_sensor_target.q).transpose()) {
    if (!(speed_radps_ > 0)) return;
    const Vec3 axis = scan.rates.omega_radps / speed_radps_;
    Mat3 cross;
    cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
    sine_ = -still_ * cross;
    versine_ = still_ * cross * cross;
  }
  // Rotation from sensor to target axes, and where the sensor is in the target's frame.
  Mat3 R_target_sensor(double dt_s) const {
    const double angle_rad = speed_radps_ * dt_s;
    return still_ + std::sin(angle_rad) * sine_ + (1 - std::cos(angle_rad)) * versine_;
  }
  Vec3 sensor_m(const Mat3& R_target_sensor, double dt_s) const { return -(R_target_sensor * (p_ + dt_s * v_mps_)); }

 private:
  Vec3 p_, v_mps_;
  double speed_radps_;
  Mat3 still_, sine_ = Mat3::Zero(), versine_ = Mat3::Zero();  // Rodrigues' formula, times the attitude at dt_s = 0
};

float residual_m(const MovingTarget& target, double dt_s, const RangeSample& sample, const sim::RayCaster& model) {
  const Mat3 R_target_sensor = target.R_target_sensor(dt_s);
  Vec3 direction;
  for (int i = 0; i < 3; ++i) direction[i] = static_cast<double>(sample.direction[i]);
  if (!(direction.squaredNorm() > 0)) return kNothing;
  const sim::RayHit hit = model.cast(target.sensor_m(R_target_sensor, dt_s), R_target_sensor * direction.normalized());
  return hit.hit ? static_cast<float>(static_cast<double>(sample.range_m) - hit.range_m) : kNothing;
}

float sigma_m(const ScanView& scan, const RangeSample& sample) {
  const double range_m = static_cast<double>(sample.range_m);
  return sample.sigma_factor * static_cast<float>(std::hypot(scan.sigma0_m, scan.sigma_k_per_m * range_m * range_m));
}

CloudPoint point_of(const ScanView& scan, const MovingTarget& target, const RangeSample& sample, const sim::RayCaster& model) {
  CloudPoint point;
  std::memcpy(point.direction, sample.direction, sizeof point.direction);
  point.range_m = sample.range_m;
  point.sigma_factor = sample.sigma_factor;
  point.offset_us = static_cast<std::int32_t>(sample.t_us - scan.t_us);
  point.state = static_cast<std::uint8_t>(sample.state);
  point.part = scan.part;
  if (sample.state != RayState::kHit) return point;
  point.x = sample.range_m * sample.direction[0];
  point.y = sample.range_m * sample.direction[1];
  point.z = sample.range_m * sample.direction[2];
  point.sigma_m = sigma_m(scan, sample);
  point.residual_m = residual_m(target, to_seconds(sample.t_us - scan.t_us), sample, model);
  return point;
}

}  // namespace

ros::PointCloud scan_cloud(const ScanView& scan, const sim::RayCaster& model) {
  ros::PointCloud cloud{cloud_fields(), sizeof(CloudPoint), {}};
  cloud.data.reserve(scan.samples.size() * sizeof(CloudPoint));
  const MovingTarget target(scan);
  for (const RangeSample& sample : scan.samples) {
    const CloudPoint point = point_of(scan, target, sample, model);
    cloud.data.append(reinterpret_cast<const char*>(&point), sizeof point);
  }
  return cloud;
}

std::vector<float> residuals_of(const ScanView& scan, const sim::RayCaster& model) {
  std::vector<float> residuals;
  const MovingTarget target(scan);
  for (const RangeSample& sample : scan.samples) {
    const bool returned = sample.state == RayState::kHit;
    residuals.push_back(returned ? residual_m(target, to_seconds(sample.t_us - scan.t_us), sample, model) : kNothing);
  }
  return residuals;
}

ros::PointCloud missed_cloud(const ScanView& scan) {
  ros::PointCloud cloud{{cloud_fields().begin(), cloud_fields().begin() + 3}, 12, {}};
  const auto range_m = static_cast<float>(scan.T_sensor_target.p.norm());
  for (const RangeSample& sample : scan.samples) {
    if (sample.state != RayState::kMiss) continue;
    for (const float component : sample.direction) mcap::put(range_m * component, cloud.data);
  }
  return cloud;
}

bool samples_of(const ros::PointCloud& cloud, TimeUs t_us, std::vector<RangeSample>& samples) {
  if (cloud.step != sizeof(CloudPoint) || cloud.data.size() % sizeof(CloudPoint) != 0) return false;
  for (std::size_t at = 0; at < cloud.data.size(); at += sizeof(CloudPoint)) {
    CloudPoint point;
    std::memcpy(&point, cloud.data.data() + at, sizeof point);
    if (point.state > static_cast<std::uint8_t>(RayState::kLost)) return false;
    RangeSample sample;
    std::memcpy(sample.direction, point.direction, sizeof point.direction);
    sample.range_m = point.range_m;
    sample.sigma_factor = point.sigma_factor;
    sample.t_us = t_us + point.offset_us;
    sample.state = static_cast<RayState>(point.state);
    samples.push_back(sample);
  }
  return true;
}

}  // namespace lasso::mdat
