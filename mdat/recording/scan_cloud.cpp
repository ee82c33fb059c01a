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
  std::uint8_t state = 0, unused[3] = {};
};
static_assert(sizeof(CloudPoint) == 44, "no padding");

const std::vector<ros::PointField>& cloud_fields() {
  static const std::vector<ros::PointField> kFields = {
      {"x", 0, ros::FieldType::kFloat32},         {"y", 4, ros::FieldType::kFloat32},
      {"z", 8, ros::FieldType::kFloat32},         {"ux", 12, ros::FieldType::kFloat32},
      {"uy", 16, ros::FieldType::kFloat32},       {"uz", 20, ros::FieldType::kFloat32},
      {"range", 24, ros::FieldType::kFloat32},    {"sigma_factor", 28, ros::FieldType::kFloat32},
      {"residual", 32, ros::FieldType::kFloat32}, {"offset_us", 36, ros::FieldType::kInt32},
      {"state", 40, ros::FieldType::kUint8}};
  return kFields;
}

float residual_m(const ScanView& scan, const RangeSample& sample, const sim::RayCaster& model) {
  const Pose T_target_sensor = inverse(propagate(scan.T_sensor_target, scan.rates, to_seconds(sample.t_us - scan.t_us)));
  Vec3 direction;
  for (int i = 0; i < 3; ++i) direction[i] = static_cast<double>(sample.direction[i]);
  const sim::RayHit hit = model.cast(T_target_sensor.p, rotate(T_target_sensor.q, direction.normalized()));
  return hit.hit ? static_cast<float>(static_cast<double>(sample.range_m) - hit.range_m) : kNothing;
}

CloudPoint point_of(const ScanView& scan, const RangeSample& sample, const sim::RayCaster& model) {
  CloudPoint point;
  std::memcpy(point.direction, sample.direction, sizeof point.direction);
  point.range_m = sample.range_m;
  point.sigma_factor = sample.sigma_factor;
  point.offset_us = static_cast<std::int32_t>(sample.t_us - scan.t_us);
  point.state = static_cast<std::uint8_t>(sample.state);
  if (sample.state != RayState::kHit) return point;
  point.x = sample.range_m * sample.direction[0];
  point.y = sample.range_m * sample.direction[1];
  point.z = sample.range_m * sample.direction[2];
  point.residual_m = residual_m(scan, sample, model);
  return point;
}

}  // namespace

ros::PointCloud scan_cloud(const ScanView& scan, const sim::RayCaster& model) {
  ros::PointCloud cloud{cloud_fields(), sizeof(CloudPoint), {}};
  for (const RangeSample& sample : scan.samples) {
    const CloudPoint point = point_of(scan, sample, model);
    cloud.data.append(reinterpret_cast<const char*>(&point), sizeof point);
  }
  return cloud;
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
