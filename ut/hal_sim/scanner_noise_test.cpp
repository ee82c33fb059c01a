// Statistics of what is imperfect about the simulated scanner, against what its model promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "hal_sim/scanner.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::ShapeMesh;

constexpr int kRays = 40000;

// A wall through the target's origin at 3 m, turned by `incidence_rad` about the sensor's x axis.
struct Wall {
  std::unique_ptr<RayCaster> target;
  ConstantTwist motion;

  explicit Wall(double incidence_rad, const ShapeMesh& mesh = wall_mesh())
      : target(make_ray_caster(mesh.vertices, mesh.triangles)),
        motion({Pose{exp_so3(Vec3(incidence_rad, 0, 0)), Vec3(0, 0, 3)}, Twist{}}, 0) {}

  static ShapeMesh wall_mesh() {
    ShapeMesh mesh;
    mesh.quad(Vec3(-50, -50, 0), Vec3(50, -50, 0), Vec3(50, 50, 0), Vec3(-50, 50, 0));
    return mesh;
  }
  RaySimulator rays(const ScannerModel& model, std::uint64_t seed = 17) const { return RaySimulator(*target, motion, model, seed); }
};

const Vec3 kDirection = Vec3(0.02, 0.05, 1).normalized();

struct Statistics {
  double mean = 0, sigma = 0;
  int hits = 0, misses = 0, invalid = 0;
};

Statistics measure(const RaySimulator& rays, const Vec3& direction = kDirection) {
  Statistics s;
  double sum = 0, sum2 = 0;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const RangeSample sample = rays.measure(i / 1024, i % 1024, direction, 0);
    s.hits += sample.state == RayState::kHit ? 1 : 0;
    s.misses += sample.state == RayState::kMiss ? 1 : 0;
    s.invalid += sample.state == RayState::kInvalid ? 1 : 0;
    if (sample.state != RayState::kHit) {
      EXPECT_EQ(sample.range_m, 0);
      continue;
    }
    sum += static_cast<double>(sample.range_m) - 3;
    sum2 += std::pow(static_cast<double>(sample.range_m) - 3, 2);
  }
  s.mean = 3 + sum / s.hits;
  s.sigma = std::sqrt(std::max(0.0, sum2 / s.hits - std::pow(sum / s.hits, 2)));
  return s;
}

double wall_range(double incidence_rad, const Vec3& direction = kDirection) {
  const Vec3 normal(0, -std::sin(incidence_rad), std::cos(incidence_rad));
  return 3 * normal.z() / normal.dot(direction);
}

double share_bound(double share) { return 4.5 * std::sqrt(share * (1 - share) / kRays); }

TEST(ScannerNoise, RangeNoiseIsUnbiasedAndOfTheModelsSize) {
  VERIFIES("LASSO-SIM-013~1");
  const Wall wall(0.5);
  ScannerModel model;
  model.sigma0_m = 4e-4;
  model.sigma_k_per_m = 1e-4;
  const double truth = wall_range(0.5);
  const double sigma = std::hypot(4e-4, 1e-4 * std::pow(truth * kDirection.z(), 2));
  for (const std::uint64_t seed : {1ULL, 2ULL, 3ULL}) {
    const Statistics s = measure(wall.rays(model, seed));
    EXPECT_EQ(s.hits, kRays);
    EXPECT_NEAR(s.mean, truth, 4.5 * sigma / std::sqrt(double{kRays}));
    EXPECT_NEAR(s.sigma / sigma, 1, 4.5 / std::sqrt(2.0 * kRays));
  }
}

// A wall across the boresight at each range: the spread of its returns, and none beyond the LIDAR's limits.
TEST(ScannerNoise, ALidarMeasuresFromOneToAHundredMetresAlike) {
  VERIFIES("LASSO-SIM-033~1 LASSO-SIM-012~1");
  const ShapeMesh mesh = Wall::wall_mesh();
  const std::unique_ptr<RayCaster> target = make_ray_caster(mesh.vertices, mesh.triangles);
  const Vec3 boresight(0, 0, 1);
  for (const double range_m : {1.1, 5.0, 20.0, 60.0, 99.5}) {
    const ConstantTwist motion({Pose{Quat::Identity(), Vec3(0, 0, range_m)}, Twist{}}, 0);
    double sum = 0;
    double sum2 = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const RangeSample sample = RaySimulator(*target, motion, time_of_flight_lidar(), 5).measure(0, i, boresight, 0);
      ASSERT_EQ(sample.state, RayState::kHit) << range_m;
      const double error = static_cast<double>(sample.range_m) - range_m;
      sum += error;
      sum2 += error * error;
    }
    EXPECT_NEAR(sum / kRays, 0, 4.5 * 0.021 / std::sqrt(double{kRays})) << range_m;
    EXPECT_NEAR(std::sqrt(sum2 / kRays), 0.020, 0.001) << range_m;
  }
  for (const auto& [range_m, state] : {std::pair{0.9, RayState::kInvalid}, std::pair{100.1, RayState::kMiss}}) {
    const ConstantTwist motion({Pose{Quat::Identity(), Vec3(0, 0, range_m)}, Twist{}}, 0);
    EXPECT_EQ(RaySimulator(*target, motion, time_of_flight_lidar(), 5).measure(0, 0, boresight, 0).state, state);
  }
}

TEST(ScannerNoise, WithoutNoiseEveryRayIsExact) {
  VERIFIES("LASSO-SIM-009~1");
  const Statistics s = measure(Wall(0.5).rays(ScannerModel{}));
  EXPECT_EQ(s.hits, kRays);
  EXPECT_NEAR(s.mean, wall_range(0.5), 2e-7);
  EXPECT_LT(s.sigma, 1e-9);
}

// On a wall at incidence i, a ray off by d in the plane of incidence meets it r tan(i) d farther: the reported direction stays nominal.
TEST(ScannerNoise, AngleNoiseMovesTheRayAndNotTheReport) {
  VERIFIES("LASSO-SIM-014~1");
  const double incidence = 0.6;
  const Wall wall(incidence);
  ScannerModel model;
  model.sigma_angle_rad = 2e-4;
  const Vec3 normal(0, -std::sin(incidence), std::cos(incidence));
  const double truth = wall_range(incidence);
  const double cos_i = normal.dot(kDirection);
  const double sigma = truth * std::sqrt(1 - cos_i * cos_i) / cos_i * model.sigma_angle_rad;
  const RaySimulator rays = wall.rays(model);
  const Statistics s = measure(rays);
  EXPECT_NEAR(s.sigma / sigma, 1, 4.5 / std::sqrt(2.0 * kRays) + 1e-3);
  EXPECT_NEAR(s.mean, truth, 4.5 * sigma / std::sqrt(double{kRays}) + 1e-6);
  const RangeSample sample = rays.measure(0, 0, kDirection, 0);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(sample.direction[axis], static_cast<float>(kDirection[axis]));
}

TEST(ScannerNoise, DropoutsAreMissesOfTheStatedShare) {
  VERIFIES("LASSO-SIM-015~1");
  const Wall wall(0.3);
  for (const double share : {0.02, 0.2, 1.0}) {
    ScannerModel model;
    model.dropout_probability = share;
    const Statistics s = measure(wall.rays(model));
    EXPECT_NEAR(double(s.misses) / kRays, share, share_bound(share));
    EXPECT_EQ(s.hits + s.misses, kRays);
  }
}

TEST(ScannerNoise, GrazingReturnsAreLost) {
  VERIFIES("LASSO-SIM-015~1");
  ScannerModel model;
  model.dropout_incidence_rad = 1.2;
  const Vec3 boresight(0, 0, 1);
  EXPECT_EQ(measure(Wall(1.199).rays(model), boresight).hits, kRays);
  EXPECT_EQ(measure(Wall(1.201).rays(model), boresight).misses, kRays);
  EXPECT_EQ(measure(Wall(M_PI - 1.201).rays(model), boresight).misses, kRays);  // seen from its back
  EXPECT_EQ(measure(Wall(1.201).rays(ScannerModel{}), boresight).hits, kRays);
}

TEST(ScannerNoise, OutliersAreUniformAlongHitAndMissedRays) {
  VERIFIES("LASSO-SIM-016~1");
  ScannerModel model;
  model.outlier_probability = 0.3;
  model.range_min_m = 0.5;
  const Wall wall(0.1);
  const Vec3 behind = Vec3(0.1, 0, -1).normalized();  // no target there
  const RaySimulator rays = wall.rays(model);
  for (const Vec3& direction : {kDirection, behind}) {
    std::vector<double> outliers;
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const RangeSample sample = rays.measure(0, i, direction, 0);
      const bool is_true_hit = std::abs(static_cast<double>(sample.range_m) - wall_range(0.1)) < 1e-6 && direction.z() > 0;
      if (sample.state == RayState::kHit && !is_true_hit) outliers.push_back(static_cast<double>(sample.range_m));
    }
    EXPECT_NEAR(static_cast<double>(outliers.size()) / kRays, 0.3, share_bound(0.3));
    std::sort(outliers.begin(), outliers.end());
    double distance = 0;  // Kolmogorov-Smirnov against the uniform distribution over 0.5 m .. 1.5 * 3 m
    for (std::size_t i = 0; i < outliers.size(); ++i) {
      const double truth = (outliers[i] - 0.5) / 4.0;
      distance = std::max(distance, std::abs(truth - static_cast<double>(i) / static_cast<double>(outliers.size())));
    }
    EXPECT_LT(distance, 2.2 / std::sqrt(static_cast<double>(outliers.size())));
    EXPECT_GE(outliers.front(), 0.5);
    EXPECT_LE(outliers.back(), 4.5);
  }
}

// A near half wall (x < 0, sensor frame) 0.4 m before a far wall: only rays within the footprint of the edge mix, and only between the two.
TEST(ScannerNoise, RangesMixAtTheEdgeBetweenTwoSurfaces) {
  VERIFIES("LASSO-SIM-017~1");
  ShapeMesh mesh;
  mesh.quad(Vec3(-50, -50, -0.4), Vec3(0, -50, -0.4), Vec3(0, 50, -0.4), Vec3(-50, 50, -0.4));
  mesh.quad(Vec3(-50, -50, 0), Vec3(50, -50, 0), Vec3(50, 50, 0), Vec3(-50, 50, 0));
  const Wall wall(0, mesh);
  ScannerModel model;
  model.edge_mixing_m = 0.01;
  model.edge_mixing_probability = 0.6;
  const RaySimulator rays = wall.rays(model);
  const auto mixed = [&](double x_at_near_m) {
    const Vec3 direction = Vec3(x_at_near_m / 2.6, 0.01, 1).normalized();
    int count = 0;
    for (std::uint32_t i = 0; i < kRays / 4; ++i) {
      const double z = static_cast<double>(rays.measure(1, i, direction, 0).range_m) * direction.z();
      EXPECT_GE(z, 2.6 - 1e-4);
      EXPECT_LE(z, 3.0 + 1e-3);
      count += z > 2.6 + 1e-3 && z < 3.0 - 1e-3 ? 1 : 0;
    }
    return count / (kRays / 4.0);
  };
  EXPECT_NEAR(mixed(-0.005), 0.6, 0.025);
  EXPECT_NEAR(mixed(+0.005), 0.6, 0.025);
  EXPECT_EQ(mixed(-0.012), 0);
  EXPECT_EQ(mixed(+0.012), 0);
  // A beam that widens has the same footprint here (10 mm at 2.6 m).
  ScannerModel widening = model;
  widening.edge_mixing_m = 0;
  widening.beam_divergence_rad = 0.01 / 2.6;
  const RaySimulator widened = wall.rays(widening);
  const Vec3 inside = Vec3(-0.005 / 2.6, 0.01, 1).normalized();
  const Vec3 outside = Vec3(-0.012 / 2.6, 0.01, 1).normalized();
  int mixed_inside = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    mixed_inside += static_cast<double>(widened.measure(1, i, inside, 0).range_m) * inside.z() > 2.6 + 1e-3 ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(widened.measure(1, i, outside, 0).range_m) * outside.z(), 2.6, 1e-5);
  }
  EXPECT_NEAR(mixed_inside / 1000.0, 0.6, 0.08);
  // An oblique wall alone has no edge: its footprint's ranges differ, and nothing mixes.
  EXPECT_LT(measure(Wall(1.2).rays(model)).sigma, 1e-9);
}

TEST(ScannerNoise, RangesAreQuantised) {
  VERIFIES("LASSO-SIM-018~1");
  ScannerModel model;
  model.range_step_m = 0.01;
  model.sigma0_m = 0.05;
  const Wall wall(0.4);
  const RaySimulator stepped = wall.rays(model);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const double steps = static_cast<double>(stepped.measure(0, i, kDirection, 0).range_m) / 0.01;
    ASSERT_NEAR(steps, std::round(steps), 1e-4);
  }
  EXPECT_NEAR(measure(stepped).mean, wall_range(0.4), 4.5 * 0.05 / std::sqrt(double{kRays}));
}

TEST(ScannerNoise, RangeLimitsDecideTheState) {
  VERIFIES("LASSO-SIM-012~1");
  const Wall wall(0.2);
  ScannerModel model;
  model.range_max_m = wall_range(0.2) - 0.001;
  EXPECT_EQ(measure(wall.rays(model)).misses, kRays);
  model.range_max_m += 0.002;
  EXPECT_EQ(measure(wall.rays(model)).hits, kRays);
  model.range_min_m = wall_range(0.2) + 0.0005;
  EXPECT_EQ(measure(wall.rays(model)).invalid, kRays);
}

TEST(ScannerNoise, AModelOutOfRangeIsRefused) {
  VERIFIES("LASSO-SIM-007~1");
  const Wall wall(0.2);
  ScannerModel model;
  model.sigma0_m = -1;
  EXPECT_THROW(wall.rays(model), std::invalid_argument);
  EXPECT_THROW(SimulatedScanner(*wall.target, wall.motion, model, 1), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::sim
