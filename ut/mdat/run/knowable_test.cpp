#include "mdat/run/knowable.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kTurn = 2 * kPi;

// Corners of both signs, and each face by two triangles.
Mesh box_of(double x, double y, double z) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back((k & 1) != 0 ? x / 2 : -x / 2, (k & 2) != 0 ? y / 2 : -y / 2, (k & 4) != 0 ? z / 2 : -z / 2);
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

// About x, closed by fans about the ends' middles.
Mesh prism_of(std::uint32_t sides, double half, double radius) {
  Mesh mesh{{{-half, 0, 0}, {half, 0, 0}}, {}};
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double angle = kTurn * k / sides;
    for (const double x : {-half, half}) mesh.vertices.emplace_back(x, radius * std::cos(angle), radius * std::sin(angle));
  }
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t low = 2 + 2 * k, next = 2 + 2 * ((k + 1) % sides);
    for (const auto& t : {std::array{low, next, next + 1}, std::array{low, next + 1, low + 1}, std::array{0U, next, low},
                          std::array{1U, low + 1, next + 1}})
      mesh.triangles.push_back(t);
  }
  return mesh;
}

// Rays of a square raster of `side` x `side` over the angles +-half, all of which met what the pose says.
std::vector<RangeSample> raster(const sim::RayCaster& target, const Pose& T_sensor_target, int side, double half_rad) {
  std::vector<RangeSample> scan;
  const Pose T_target_sensor = inverse(T_sensor_target);
  for (int i = 0; i < side * side; ++i) {
    const double x = half_rad * (2.0 * (i % side) / (side - 1) - 1), y = half_rad * (2.0 * (i / side) / (side - 1) - 1);
    const Vec3 u = Vec3(x, y, 1).normalized();
    RangeSample sample;
    for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(u[axis]);
    const sim::RayHit hit = target.cast(T_target_sensor.p, rotate(T_target_sensor.q, u));
    sample.state = hit.hit ? RayState::kHit : RayState::kMiss;
    sample.range_m = static_cast<float>(hit.range_m);
    scan.push_back(sample);
  }
  return scan;
}

bool determined(const Mesh& mesh, const Quat& attitude, double sigma_m, double half_rad = 0.2) {
  const KnowableTarget target(mesh, 30 * kRadPerDeg, {sigma_m, 0, 0, 0}, 2);
  const Pose pose{attitude, Vec3(0, 0, 6)};
  return target.is_determined(pose, raster(target.surface(), pose, 32, half_rad));
}

const Quat kAskew = normalized(Quat(0.8, 0.3, -0.4, 0.2));

TEST(Knowable, ThreeFacesOfABoxTellItsPose) {
  VERIFIES("LASSO-GND-114~1");
  EXPECT_TRUE(determined(box_of(2, 1.5, 1), kAskew, 0.003));
}

TEST(Knowable, NoiseTooLargeLeavesItOpen) {
  VERIFIES("LASSO-GND-114~1");
  EXPECT_FALSE(determined(box_of(2, 1.5, 1), kAskew, 1.0, 0.05));  // the whole field inside of the outline: no label helps
}

// One face alone leaves three directions open; the outline of it closes them where the scan sees the outline.
TEST(Knowable, LabelsOfTheOutlineCloseWhatOneFaceLeavesOpen) {
  VERIFIES("LASSO-GND-114~1");
  EXPECT_FALSE(determined(box_of(2, 2, 0.5), Quat::Identity(), 0.001, 0.1));
  EXPECT_TRUE(determined(box_of(2, 1.2, 0.5), Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ())), 0.001, 0.2));
}

TEST(Knowable, ABareCylinderOfManySidesHasNoRoll) {
  VERIFIES("LASSO-GND-114~1");
  const auto turned = [](std::uint32_t sides) { return prism_of(sides, 1, 0.6); };
  EXPECT_FALSE(determined(turned(48), kAskew, 0.0003));
  EXPECT_TRUE(determined(turned(8), kAskew, 0.0003));  // facets of 45 deg are no round body's
}

}  // namespace
}  // namespace lasso::mdat
