// Scans of the test box by a closed-form ray caster: the truth that the estimation tests measure against.
#pragma once

#include <memory>

#include "fsw/geometry/se3.hpp"
#include "fsw/sense/range_image.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/generator.hpp"

namespace lasso::test {

struct BoxScan {
  BoxModel model;        // what the scan is aimed at
  Boxes others;          // in the scene too
  Pose T_sensor_target;  // at the scan's reference time
  Twist rates;
  double sigma_m = 0;  // range noise
  double dropouts = 0;
  double outliers = 0;
  int side = 32;  // rays each way
  double half_angle = 0.16;
  DurationUs duration_us = 180000;
};

// A raster of side x side rays around the box's centre, with the target moving while it is scanned.
inline std::unique_ptr<RangeImage> scan_box(const BoxScan& s, Generator& random) {
  auto image = std::make_unique<RangeImage>();
  Boxes scene = s.others;
  scene.push_back(s.model);
  const Vec3 aim = s.T_sensor_target * s.model.center;
  const int rays = s.side * s.side;
  for (int i = 0; i < rays; ++i) {
    const double x = aim[0] / aim[2] + s.half_angle * (2.0 * (i % s.side) / (s.side - 1) - 1);
    const double y = aim[1] / aim[2] + s.half_angle * (2.0 * (i / s.side) / (s.side - 1) - 1);
    RangeSample sample;
    const Vec3 u = Vec3(x, y, 1).normalized();
    for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(u[k]);
    const Vec3 exact(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                     static_cast<double>(sample.direction[2]));
    sample.t_us = 1000000 + s.duration_us * i / (rays - 1);
    const Pose T_target_sensor = inverse(propagate(s.T_sensor_target, s.rates, to_seconds(sample.t_us - 1000000 - s.duration_us / 2)));
    double range = cast_boxes(scene, T_target_sensor.p, rotate(T_target_sensor.q, exact));
    if (random.uniform(0, 1) < s.dropouts) range = -1;
    if (range > 0) range += s.sigma_m * random.normal();
    if (random.uniform(0, 1) < s.outliers) range = aim[2] * random.uniform(0.5, 1.5);
    sample.state = range > 0 ? RayState::kHit : RayState::kMiss;
    sample.range_m = range > 0 ? static_cast<float>(range) : 0;
    (void)image->samples.push_back(sample);
  }
  return image;
}

// A generic attitude that shows three faces, about 2.5 m away.
inline Pose generic_box_pose() {
  Pose pose;
  pose.q = exp_so3(Vec3(0.5, -0.65, 0.3));
  pose.p = Vec3(0.05, -0.03, 2.5);
  return pose;
}

// A rotation and a shift within +-limits, seeded.
inline Pose disturb(const Pose& pose, double rotation_rad, double shift_m, Generator& random) {
  auto draw = [&random] {
    Vec3 v;
    for (int i = 0; i < 3; ++i) v[i] = random.uniform(-1, 1);
    return v;
  };
  Pose result;
  result.q = exp_so3(rotation_rad * draw()) * pose.q;
  result.p = pose.p + shift_m * draw();
  return result;
}

}  // namespace lasso::test
