// What surfaces send back into a laser's beam, against integrals that do not know the closed form.
#include "hal_sim/laser_reflection.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

Vec3 at_angle(double angle_rad, double turn_rad) {
  return {std::sin(angle_rad) * std::cos(turn_rad), std::sin(angle_rad) * std::sin(turn_rad), std::cos(angle_rad)};
}

TEST(LaserReflection, APlainSurfaceReturnsTheCosine) {
  VERIFIES("LASSO-SIM-061~1");
  for (const double angle_rad : {0.0, 0.4, 1.1, 1.5}) {
    EXPECT_NEAR(backscatter({0.6, 0, 1}, std::cos(angle_rad)), 0.6 * std::cos(angle_rad), 1e-15);
  }
}

// Slopes of GGX drawn by its inverse distribution: facets whose normals lie within a small cone about the beam mirror it back.
TEST(LaserReflection, TheLobeIsWhatDrawnMirrorsReturn) {
  VERIFIES("LASSO-SIM-061~1");
  test::Generator generator(5);
  constexpr int kMirrors = 4000000;
  constexpr double kCone_rad = 0.03, kAlpha = 0.2;
  const double cone_sr = 2 * M_PI * (1 - std::cos(kCone_rad));
  std::array<double, 3> angles_rad = {0.0, 0.15, 0.35};
  std::array<int, 3> within{};
  for (int i = 0; i < kMirrors; ++i) {
    const double u = generator.uniform(0, 1);
    const double cosine = 1 / std::sqrt(1 + kAlpha * kAlpha * u / (1 - u)), turn_rad = generator.uniform(-M_PI, M_PI);
    const Vec3 normal = at_angle(std::acos(cosine), turn_rad);
    for (std::size_t k = 0; k < angles_rad.size(); ++k) within[k] += normal.dot(at_angle(angles_rad[k], 0)) > std::cos(kCone_rad) ? 1 : 0;
  }
  for (std::size_t k = 0; k < angles_rad.size(); ++k) {
    // Density of projected area D cos(i), 1/sr; a mirror turned by da turns its light by 2 da: four times the solid angle.
    const double projected = within[k] / (kMirrors * cone_sr);
    const double c = std::cos(angles_rad[k]), tangent2 = (1 - c * c) / (c * c);
    const double seen = 1 / std::sqrt(1 + kAlpha * kAlpha * tangent2);  // Smith, both ways at once
    const double expected = M_PI * 0.8 * (projected / c) * seen / (4 * c);
    EXPECT_NEAR(backscatter({0, 0.8, kAlpha}, c), expected, 0.05 * expected) << angles_rad[k];
  }
  EXPECT_NEAR(backscatter({0.1, 0.8, kAlpha}, 1), 0.1 + 0.8 / (4 * kAlpha * kAlpha), 1e-12);
}

TEST(LaserReflection, AMirrorReturnsNothingOffItsNormal) {
  VERIFIES("LASSO-SIM-061~1");
  const LaserReflection mirror{0, 0.9, 0.02};
  EXPECT_GT(backscatter(mirror, 1), 500);
  EXPECT_LT(backscatter(mirror, std::cos(0.5)), 0.01);
}

TEST(LaserReflection, LightBackIntoTheBeamIsTheSameByBothFunctions) {
  VERIFIES("LASSO-SIM-061~1");
  test::Generator generator(7);
  for (int i = 0; i < 200; ++i) {
    const LaserReflection surface{generator.uniform(0, 0.5), generator.uniform(0, 0.5), generator.uniform(0.05, 1)};
    const Vec3 normal = at_angle(generator.uniform(0, 3), generator.uniform(-3, 3)), beam = at_angle(generator.uniform(0, 3), 1);
    const double cosine = std::abs(normal.dot(beam));
    const double expected = backscatter(surface, cosine);
    EXPECT_NEAR(M_PI * radiance_per_sr(surface, normal, beam, beam), expected, 1e-9 * expected);
  }
}

// No more light leaves than comes: the directional albedo by quadrature over the hemisphere.
TEST(LaserReflection, NoMoreLightLeavesThanComes) {
  VERIFIES("LASSO-SIM-061~1");
  constexpr int kSteps = 300;
  for (const double incidence_rad : {0.1, 0.8, 1.2}) {
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double out_rad = (i + 0.5) * M_PI / 2 / kSteps;
      for (int k = 0; k < kSteps; ++k) {
        const double radiance =
            radiance_per_sr({0.3, 0.6, 0.2}, Vec3::UnitZ(), at_angle(incidence_rad, 0), at_angle(out_rad, (k + 0.5) * 2 * M_PI / kSteps));
        sum += radiance * std::cos(out_rad) * std::sin(out_rad) * (M_PI / 2 / kSteps) * (2 * M_PI / kSteps);
      }
    }
    EXPECT_LT(sum, std::cos(incidence_rad) * 1.02);
    EXPECT_GT(sum, 0.85 * 0.9 * std::cos(incidence_rad));
  }
  EXPECT_EQ(radiance_per_sr({0.3, 0.6, 0.2}, Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitZ()), 0);
}

}  // namespace
}  // namespace lasso::sim
