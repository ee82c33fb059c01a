// Light through clouds, against sums over small steps that know nothing of shapes.
#include "hal_sim/scatter_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

ScatterVolume even_sphere() {
  ScatterVolume volume;
  volume.radius_m = 2;
  volume.core_m = 2;
  volume.extinction_per_m = 0.3;
  return volume;
}

ScatterVolume plume() {
  ScatterVolume volume;
  volume.shape = ScatterShape::kCone;
  volume.half_angle_rad = 0.4;
  volume.length_m = 6;
  volume.core_m = 0.5;
  volume.extinction_per_m = 2;
  return volume;
}

double summed_depth(const ScatterVolume& volume, const Vec3& origin, const Vec3& direction, double range_m) {
  constexpr int kSteps = 40000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += extinction_per_m(volume, origin + (i + 0.5) * range_m / kSteps * direction) * range_m / kSteps;
  return sum;
}

TEST(ScatterVolume, TheDepthOfAnEvenSphereIsItsChord) {
  VERIFIES("LASSO-SIM-068~1");
  const Vec3 origin(0, 1, -10);
  EXPECT_NEAR(optical_depth(even_sphere(), origin, Vec3::UnitZ(), 100), 0.3 * 2 * std::sqrt(3), 1e-12);
  EXPECT_NEAR(optical_depth(even_sphere(), origin, Vec3::UnitZ(), 10), 0.3 * std::sqrt(3), 1e-12);
  EXPECT_EQ(optical_depth(even_sphere(), origin, -Vec3::UnitZ(), 100), 0);
  EXPECT_NEAR(optical_depth(even_sphere(), Vec3::Zero(), Vec3::UnitX(), 100), 0.6, 1e-12);
}

TEST(ScatterVolume, DepthsAreTheSumsOfTheirExtinctionOnAnyRay) {
  VERIFIES("LASSO-SIM-068~1");
  test::Generator generator(3);
  ScatterVolume thinner = even_sphere();
  thinner.core_m = 0.4;
  int met = 0;
  for (int i = 0; i < 60; ++i) {
    for (const ScatterVolume& volume : {even_sphere(), thinner, plume()}) {
      const Vec3 origin = generator.uniform(0.5, 9) * test::random_unit(generator);
      const Vec3 towards = Vec3(0, 0, 1.5) + generator.uniform(0, 2) * test::random_unit(generator);
      const Vec3 direction = (towards - origin).normalized();
      const double range_m = generator.uniform(3, 15), expected = summed_depth(volume, origin, direction, range_m);
      EXPECT_NEAR(optical_depth(volume, origin, direction, range_m), expected, 2e-3 * expected + 2e-3);
      met += expected > 0.01 ? 1 : 0;
    }
  }
  EXPECT_GT(met, 80);
}

TEST(ScatterVolume, ThePlaceOfADepthIsWhereItIsReached) {
  VERIFIES("LASSO-SIM-068~1");
  test::Generator generator(4);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 origin = 8 * test::random_unit(generator);
    const Vec3 direction = (Vec3(0, 0, 1.5) + test::random_unit(generator) - origin).normalized();
    const double whole = optical_depth(plume(), origin, direction, 1e9);
    EXPECT_LT(range_of_depth(plume(), origin, direction, 1.0001 * whole + 1e-9), 0);
    if (whole < 1e-6) continue;
    ++met;
    const double depth = generator.uniform(0.01, 0.99) * whole, range_m = range_of_depth(plume(), origin, direction, depth);
    EXPECT_NEAR(optical_depth(plume(), origin, direction, range_m), depth, 1e-9);
  }
  EXPECT_GT(met, 100);
}

// By the lidar equation: what an isotropic scatterer of the extinction E sends back from the length of the pulse.
TEST(ScatterVolume, ACloudReturnsWhatItsExtinctionSays) {
  VERIFIES("LASSO-SIM-068~1");
  ScatterVolume volume = even_sphere();
  volume.lidar_ratio_sr = 4 * M_PI;
  double gathered_m = 0;  // a Gaussian pulse through a filter of its own shape, by sums
  for (double at = -3; at < 3; at += 0.001) gathered_m += 0.001 * std::exp(-at * at / (4 * 0.3 * 0.3));
  EXPECT_NEAR(volume_backscatter(volume, Vec3::Zero(), 0.3), M_PI * 0.3 * gathered_m / (4 * M_PI), 1e-6);
}

}  // namespace
}  // namespace lasso::sim
