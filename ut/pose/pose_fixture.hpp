// What the tests of the registration's stages share: a loaded mission, a workspace, scans of the box.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/prepare.hpp"
#include "fsw/pose/scan/workspace.hpp"
#include "ut/support/box_scan.hpp"
#include "ut/support/path_numbers.hpp"

namespace lasso::test {

// An image is loaded once; tests copy its mission, so that each has parameters of its own.
struct LoadedImage {
  explicit LoadedImage(const Boxes& boxes) : image(make_image(preset_parameters(), make_box_tables(boxes))) {
    EXPECT_EQ(load_image(Bytes(image.data(), image.size), mission).status, Status::kOk);
  }
  TestImage image;
  Mission mission;
};

inline const Mission& box_mission() {
  static const LoadedImage loaded(Boxes{BoxModel{}});
  return loaded.mission;
}

inline Vec3 random_vec3(Generator& random, double size) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = random.uniform(-size, size);
  return v;
}

inline Vec6 random_vec6(Generator& random, double size) {
  Vec6 v;
  for (int i = 0; i < 6; ++i) v[i] = random.uniform(-size, size);
  return v;
}

// Any attitude, the box's middle on the boresight or near it.
inline Pose random_box_pose(Generator& random) {
  Pose pose;
  for (int i = 0; i < 4; ++i) pose.q.coeffs()[i] = random.normal();
  pose.q = normalized(pose.q);
  pose.p = random_vec3(random, 0.2) + Vec3(0, 0, 2.5);
  return pose;
}

class PoseFixture : public ::testing::Test {
 protected:
  explicit PoseFixture(const Mission& mission = box_mission()) : mission_(mission) {
    scan_.T_sensor_target = generic_box_pose();
    parameters().sigma0_m = 1e-3;
    parameters().sigma_k_per_m = 0;
  }

  MissionParameters& parameters() { return mission_.parameters; }

  // Scans and prepares the rays, with the prediction at the truth.
  void scan() {
    image_ = scan_box(scan_, random_);
    StartPoint start;
    start.T_sensor_target = scan_.T_sensor_target;
    start.rates = scan_.rates;
    prepare_rays(mission_, *image_, start, *workspace_);
  }

  // Leaves all other points out; keep(i, point).
  template <class Keep>
  void keep_points(Keep keep) {
    const auto all = std::make_unique<Workspace>(*workspace_);
    workspace_->points.clear();
    for (std::size_t i = 0; i < all->points.size(); ++i) {
      if (keep(i, all->points[i])) (void)workspace_->points.push_back(all->points[i]);
    }
  }
  void keep_first_points(std::size_t count) {
    keep_points([count](std::size_t i, const MatchPoint<FlightNumber>&) { return i < count; });
  }

  static StartPoint tracked_at(const Pose& T_target_sensor) {
    StartPoint start;
    start.T_sensor_target = inverse(T_target_sensor);
    start.tracked = true;
    return start;
  }
  Pose truth() const { return inverse(scan_.T_sensor_target); }  // T_target_sensor
  // Rotation and translation of `T_target_sensor` against the truth, sensor axes.
  Vec6 error_of(const Pose& T_target_sensor) const { return pose_difference(inverse(T_target_sensor), scan_.T_sensor_target); }

  Mission mission_;
  std::unique_ptr<Workspace> workspace_ = std::make_unique<Workspace>();
  std::unique_ptr<RangeImage> image_;
  Generator random_{71};
  BoxScan scan_;
};

}  // namespace lasso::test
