#include "mdat/run/bound.hpp"

#include <cmath>

#include "ut/support/dense.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A closed box about the target's origin, corners at +-half.
std::unique_ptr<sim::RayCaster> make_box(const Vec3& half_m) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1 ? 1 : -1) * half_m.x(), (i & 2 ? 1 : -1) * half_m.y(), (i & 4 ? 1 : -1) * half_m.z());
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                                               {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return sim::make_ray_caster(corners, triangles);
}

RangeSample ray(double x, double y, RayState state = RayState::kHit) {
  const Vec3 u = Vec3(x, y, 1).normalized();
  RangeSample sample;
  for (int i = 0; i < 3; ++i) sample.direction[i] = static_cast<float>(u[i]);
  sample.state = state;
  return sample;
}

std::vector<RangeSample> random_scan(std::uint64_t seed, int rays, double half) {
  test::Generator random(seed);
  std::vector<RangeSample> scan;
  for (int i = 0; i < rays; ++i) {
    const double x = random.uniform(-half, half);
    const double y = random.uniform(-half, half);
    scan.push_back(ray(x, y));
  }
  return scan;
}

Pose generic_pose(double range_m) {
  Pose pose;
  pose.q = exp_so3(Vec3(0.5, -0.4, 0.3));
  pose.p = Vec3(0.05, -0.03, range_m);
  return pose;
}

// The range of a ray at a pose, by the caster alone.
double range_at(const sim::RayCaster& target, const Pose& T_sensor_target, const RangeSample& sample) {
  const Vec3 u(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
               static_cast<double>(sample.direction[2]));
  const Pose T_target_sensor = inverse(T_sensor_target);
  const sim::RayHit hit = target.cast(T_target_sensor.p, rotate(T_target_sensor.q, u));
  return hit.hit ? hit.range_m : 0;
}

double incidence_cosine(const sim::RayCaster& target, const Pose& T_sensor_target, const RangeSample& sample) {
  const Vec3 u(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
               static_cast<double>(sample.direction[2]));
  const Pose T_target_sensor = inverse(T_sensor_target);
  const Vec3 v = rotate(T_target_sensor.q, u);
  const sim::RayHit hit = target.cast(T_target_sensor.p, v);
  return hit.hit ? std::fabs(hit.normal.dot(v)) : 0;
}

TEST(Bound, IsTheInverseOfTheInformationOfFiniteDifferences) {
  VERIFIES("LASSO-MDT-001~1");
  const auto box = make_box({0.2, 0.3, 0.4});
  const Pose truth = generic_pose(3);
  const std::vector<RangeSample> scan = random_scan(7, 300, 0.08);
  const double sigma = 0.002, step = 1e-5;
  Mat6 information = Mat6::Zero();
  int counted = 0;
  for (const RangeSample& sample : scan) {
    if (incidence_cosine(*box, truth, sample) < std::cos(kBoundIncidenceMax_rad)) continue;
    Vec6 gradient;
    bool smooth = true;
    for (int i = 0; i < 6; ++i) {
      Vec6 d = Vec6::Zero();
      d[i] = step;
      Pose plus = truth, minus = truth;
      plus.q = exp_so3(d.head<3>()) * truth.q;
      plus.p += d.tail<3>();
      minus.q = exp_so3(-d.head<3>()) * truth.q;
      minus.p -= d.tail<3>();
      const double a = range_at(*box, plus, sample), b = range_at(*box, minus, sample);
      smooth = smooth && a > 0 && b > 0 && std::fabs(a - b) < 100 * step;
      gradient[i] = (a - b) / (2 * step);
    }
    ASSERT_TRUE(smooth) << "the seed puts no ray on an edge";
    information += gradient * gradient.transpose() / (sigma * sigma);
    ++counted;
  }
  ASSERT_GT(counted, 100);
  const Mat6 covariance = test::inverse_of(information);
  const PoseBound bound = pose_bound(*box, truth, scan, [&](double) { return sigma; });
  ASSERT_TRUE(bound.defined);
  const double rotation_rad2 = covariance.diagonal().head<3>().sum(), translation_m2 = covariance.diagonal().tail<3>().sum();
  EXPECT_NEAR(bound.rotation_rad2 / rotation_rad2, 1, 1e-4);
  EXPECT_NEAR(bound.translation_m2 / translation_m2, 1, 1e-4);
}

TEST(Bound, GrowsWithTheSquareOfTheNoiseAndFallsWithTheNumberOfScans) {
  VERIFIES("LASSO-MDT-001~1");
  const auto box = make_box({0.2, 0.3, 0.4});
  const Pose truth = generic_pose(3);
  std::vector<RangeSample> scan = random_scan(8, 200, 0.08);
  const PoseBound one = pose_bound(*box, truth, scan, [](double) { return 0.001; });
  const PoseBound noisy = pose_bound(*box, truth, scan, [](double) { return 0.003; });
  EXPECT_NEAR(noisy.translation_m2 / one.translation_m2, 9, 1e-9);
  const std::vector<RangeSample> copy = scan;
  scan.insert(scan.end(), copy.begin(), copy.end());
  const PoseBound twice = pose_bound(*box, truth, scan, [](double) { return 0.001; });
  EXPECT_NEAR(one.rotation_rad2 / twice.rotation_rad2, 2, 1e-9);
}

TEST(Bound, AsksTheNoiseAtTheDepthAlongTheBoresight) {
  VERIFIES("LASSO-MDT-001~1");
  const auto box = make_box({1, 1, 0.5});  // its face at 2.5 m fills the view
  Pose truth;
  truth.p = Vec3(0, 0, 3);
  const std::vector<RangeSample> scan = {ray(0.1, 0.05), ray(-0.2, 0.1)};
  std::vector<double> depths;
  (void)pose_bound(*box, truth, scan, [&](double z_m) {
    depths.push_back(z_m);
    return 0.001;
  });
  ASSERT_EQ(depths.size(), 2U);
  EXPECT_NEAR(depths[0], 2.5, 1e-6);
  EXPECT_NEAR(depths[1], 2.5, 1e-6);
}

TEST(Bound, IsUndefinedWhereADirectionIsOpenOrNothingWasHit) {
  VERIFIES("LASSO-MDT-001~1");
  const auto box = make_box({1, 1, 0.5});
  Pose facing;
  facing.p = Vec3(0, 0, 3);  // only one face in view: three directions are open
  const auto sigma = [](double) { return 0.001; };
  EXPECT_FALSE(pose_bound(*box, facing, random_scan(9, 100, 0.1), sigma).defined);
  std::vector<RangeSample> misses = random_scan(10, 100, 0.08);
  for (RangeSample& sample : misses) sample.state = RayState::kMiss;
  EXPECT_FALSE(pose_bound(*box, generic_pose(3), misses, sigma).defined);
}

}  // namespace
}  // namespace lasso::mdat
