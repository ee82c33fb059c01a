#include "mdat/run/mounted_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {
namespace {

constexpr double kLeastDepth_m = 1e-3;

// A direction of the tangent plane; with a depth, the point there. Both in own axes.
Vec3 seen_from(const SensorMounting& mounting, const std::optional<double>& depth_m, double x, double y) {
  const Vec3 direction(x, y, 1);
  if (!depth_m) return rotate(mounting.T_sensor_own.q.conjugate(), direction);
  return inverse(mounting.T_sensor_own) * (*depth_m * direction).eval();
}

struct FieldInterval {
  double low = 1e30, high = -1e30;
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void cut(double limit) {
    low = std::max(low, -limit);
    high = std::min(high, limit);
  }
};

}  // namespace

Status plan_from(const SensorMounting& mounting, const std::optional<double>& depth_m, const ScanPlan& plan, ScanPlan& own) {
  FieldInterval x, y;
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-1.0, 1.0}) {
      const Vec3 corner = seen_from(mounting, depth_m, plan.center_x + side * plan.half_x, plan.center_y + end * plan.half_y);
      if (corner.z() < kLeastDepth_m) return Status::kBadValue;
      x.include(corner.x() / corner.z());
      y.include(corner.y() / corner.z());
    }
  }
  x.cut(std::tan(mounting.fov_half_x_rad));
  y.cut(std::tan(mounting.fov_half_y_rad));
  if (!(x.low < x.high && y.low < y.high)) return Status::kBadValue;
  own = plan;
  own.aimed = {};
  own.center_x = 0.5 * (x.low + x.high);
  own.center_y = 0.5 * (y.low + y.high);
  own.half_x = 0.5 * (x.high - x.low);
  own.half_y = 0.5 * (y.high - y.low);
  return Status::kOk;
}

AimedRay ray_from(const SensorMounting& mounting, const AimedRay& ray) {
  const Vec3 direction = seen_from(mounting, std::nullopt, static_cast<double>(ray.x), static_cast<double>(ray.y));
  const double x_max = std::tan(mounting.fov_half_x_rad), y_max = std::tan(mounting.fov_half_y_rad);
  const double depth = std::max(direction.z(), kLeastDepth_m);
  return {static_cast<float>(std::clamp(direction.x() / depth, -x_max, x_max)),
          static_cast<float>(std::clamp(direction.y() / depth, -y_max, y_max))};
}

RangeSample sample_in_sensor(const SensorMounting& mounting, const RangeSample& sample) {
  RangeSample moved = sample;
  const Vec3 own(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                 static_cast<double>(sample.direction[2]));
  Vec3 direction = rotate(mounting.T_sensor_own.q, own);
  if (sample.state == RayState::kMiss && mounting.is_aside()) moved.state = RayState::kInvalid;
  if (sample.state == RayState::kHit) {
    const Vec3 point_m = mounting.T_sensor_own * (static_cast<double>(sample.range_m) * own).eval();
    moved.range_m = static_cast<float>(point_m.norm());
    direction = point_m.normalized();
  }
  for (int axis = 0; axis < 3; ++axis) moved.direction[axis] = static_cast<float>(direction[axis]);
  return moved;
}

Status MountedSensor::start(const ScanPlan& plan, TimeUs t_start_us) {
  depths_m_.clear();
  if (!mounting_) return own_.start(plan, t_start_us);
  const std::optional<double> depth_m = mounting_->is_aside() ? depth_.m : std::nullopt;
  const Status status = plan_from(*mounting_, depth_m, plan, plan_);
  if (status != Status::kOk) return status;
  aimed_.clear();
  for (const AimedRay& ray : plan.aimed) static_cast<void>(aimed_.push_back(ray_from(*mounting_, ray)));
  plan_.aimed = aimed_.span();
  return own_.start(plan_, t_start_us);
}

SensorPoll MountedSensor::poll(TimeUs now_us, Span<RangeSample> out) {
  const SensorPoll result = own_.poll(now_us, out);
  for (std::size_t i = 0; i < std::min(result.count, out.size()); ++i) {
    if (mounting_) out[i] = sample_in_sensor(*mounting_, out[i]);
    note(out[i]);
  }
  if (!result.complete || depths_m_.empty()) return result;
  const auto middle = depths_m_.begin() + static_cast<std::ptrdiff_t>(depths_m_.size() / 2);
  std::nth_element(depths_m_.begin(), middle, depths_m_.end());
  depth_.m = *middle;
  return result;
}

std::uint16_t MountedSensor::samples_of(const ScanPlan& plan) const { return own_.samples_of(mounting_ ? plan_ : plan); }

void MountedSensor::note(const RangeSample& sample) {
  const double depth_m = static_cast<double>(sample.range_m) * static_cast<double>(sample.direction[2]);
  if (sample.state == RayState::kHit && depth_m > kLeastDepth_m) depths_m_.push_back(depth_m);
}

}  // namespace lasso::mdat
