#include "mdat/run/bound.hpp"

#include <cmath>

#include "fsw/geometry/symmetric6.hpp"

namespace lasso::mdat {
namespace {

// What one hit says about (rotation, translation), target axes; false where it does not count.
bool information_of(const sim::RayCaster& target, const Vec3& origin_m, const Vec3& u, Vec6& gradient, double& range_m) {
  const sim::RayHit hit = target.cast(origin_m, u);
  if (!hit.hit) return false;
  const double cosine = hit.normal.dot(u);
  if (std::fabs(cosine) < std::cos(kBoundIncidenceMax_rad)) return false;
  const Vec3 p = origin_m + hit.range_m * u;
  gradient << p.cross(hit.normal), hit.normal;
  gradient /= cosine;
  range_m = hit.range_m;
  return true;
}

}  // namespace

PoseBound pose_bound(const sim::RayCaster& target, const Pose& T_sensor_target, std::span<const RangeSample> scan,
                     const std::function<double(double)>& sigma_m) {
  const Pose T_target_sensor = inverse(T_sensor_target);
  Mat6 information = Mat6::Zero();
  for (const RangeSample& sample : scan) {
    if (sample.state != RayState::kHit) continue;
    const Vec3 direction(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                         static_cast<double>(sample.direction[2]));
    Vec6 gradient;
    double range_m = 0;
    if (!information_of(target, T_target_sensor.p, rotate(T_target_sensor.q, direction), gradient, range_m)) continue;
    const double sigma = sigma_m(range_m * direction.z());
    information += gradient * gradient.transpose() / (sigma * sigma);
  }
  Mat6 covariance;
  if (invert6(information, covariance) != Status::kOk) return {};
  return {true, covariance.bottomRightCorner<3, 3>().trace(), covariance.topLeftCorner<3, 3>().trace()};
}

}  // namespace lasso::mdat
