#include "mdat/render/light.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Over the disc by the midpoint rule: what of it is above the plate's horizon, by the cosine.
double view_factor_by_sum(double cosine, double half_angle_rad) {
  constexpr int kRings = 1500, kSectors = 1500;
  const double sine = std::sqrt(1 - cosine * cosine);
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double polar = (i + 0.5) * half_angle_rad / kRings;
    for (int j = 0; j < kSectors; ++j) {
      const double c = std::cos(polar) * cosine + std::sin(polar) * sine * std::cos((j + 0.5) * 2 * kPi / kSectors);
      if (c > 0) sum += c * std::sin(polar);
    }
  }
  return sum * (half_angle_rad / kRings) * (2 * kPi / kSectors) / kPi;
}

TEST(Light, DiscViewFactorIsTheIntegralOverWhatIsAboveTheHorizon) {
  VERIFIES("LASSO-PIC-004~1");
  for (const double half_angle : {0.3, 1.0, kEarthHalfAngle_rad}) {
    for (const double cosine : {0.97, 0.4, 0.1, -0.2, -0.7}) {
      EXPECT_NEAR(disc_view_factor(cosine, half_angle), view_factor_by_sum(cosine, half_angle), 2e-6) << half_angle << " " << cosine;
    }
  }
}

TEST(Light, DiscViewFactorIsContinuousWhereTheHorizonTouchesTheDisc) {
  VERIFIES("LASSO-PIC-004~1");
  const double half_angle = 1.1, edge = std::sin(half_angle);
  EXPECT_NEAR(disc_view_factor(edge - 1e-9, half_angle), disc_view_factor(edge + 1e-9, half_angle), 1e-8);
  EXPECT_NEAR(disc_view_factor(-edge + 1e-9, half_angle), 0, 1e-8);
  EXPECT_EQ(disc_view_factor(-1, half_angle), 0);
  EXPECT_NEAR(disc_view_factor(1, half_angle), edge * edge, 1e-12);
}

TEST(Light, DirectionsOfADiscFillItEvenly) {
  VERIFIES("LASSO-PIC-003~1");
  const Vec3 middle = Vec3(0.3, -0.8, 0.2).normalized();
  constexpr double kHalf = 0.4;
  double sum = 0;
  Vec3 mean = Vec3::Zero();
  constexpr int kCells = 100;
  for (int i = 0; i < kCells * kCells; ++i) {
    const Vec3 d = disc_direction(middle, kHalf, {(i % kCells + 0.5) / kCells, (i / kCells + 0.5) / kCells});
    ASSERT_NEAR(d.norm(), 1, 1e-12);
    ASSERT_GE(d.dot(middle), std::cos(kHalf) - 1e-12);
    sum += d.dot(middle) / (kCells * kCells);
    mean += d / (kCells * kCells);
  }
  EXPECT_NEAR(sum, (1 + std::cos(kHalf)) / 2, 1e-6);
  EXPECT_LT(mean.cross(middle).norm(), 1e-9);
}

TEST(Light, SunIsAsWideAsItIs) {
  VERIFIES("LASSO-PIC-003~1");
  EXPECT_NEAR(2 * kSunHalfAngle_rad / kRadPerDeg, 0.533, 1e-3);
  const Vec3 sun = Vec3(-0.4, 0.5, 0.9).normalized();
  EXPECT_NEAR(std::asin(disc_direction(sun, kSunHalfAngle_rad, {1, 0.3}).cross(sun).norm()), kSunHalfAngle_rad, 1e-9);
}

TEST(Light, EarthIsAsBrightAsTheGroundBelow) {
  VERIFIES("LASSO-PIC-004~1");
  Lights lights;
  lights.earth = Vec3(0, 1, 0);
  EXPECT_EQ(earth_radiance(lights), 0);  // no sun
  lights.sun = Vec3(0, -1, 0);           // at the zenith of the ground below
  EXPECT_NEAR(earth_radiance(lights), 0.3 * 1361 / kPi, 1e-9);
  lights.sun = Vec3(0, -0.6, 0.8);
  EXPECT_NEAR(earth_radiance(lights), 0.6 * 0.3 * 1361 / kPi, 1e-9);
  lights.sun = Vec3(0, 0.1, -0.9).normalized();  // it is night there
  EXPECT_EQ(earth_radiance(lights), 0);
  lights.earth.reset();
  EXPECT_EQ(earth_radiance(lights), 0);
}

TEST(Light, TangentsAreARightHandedFrame) {
  VERIFIES("LASSO-PIC-006~1");
  for (const Vec3& z : {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0.48, -0.6, 0.64)}) {
    const Tangents side = tangents_of(z);
    EXPECT_LT((side.x.cross(side.y) - z).norm(), 1e-14);
    EXPECT_NEAR(side.x.dot(z), 0, 1e-15);
    EXPECT_NEAR(side.y.norm(), 1, 1e-15);
  }
}

TEST(Light, TurnsWithTheFrame) {
  VERIFIES("LASSO-SCN-035~1");
  Lights lights;
  lights.sun = Vec3(0.6, 0, 0.8);
  lights.lamps.resize(1);
  lights.lamps[0].place_m = Vec3(1, 2, 3);
  lights.lamps[0].axis = Vec3(0, 0.6, -0.8);
  const Eigen::AngleAxisd turn(0.7, Vec3(1, -2, 0.5).normalized());
  const Lights turned = lights_in_frame(lights, {Quat(turn), Vec3(0.3, -0.1, 2)});
  EXPECT_LT((*turned.sun - turn * *lights.sun).norm(), 1e-12);
  EXPECT_LT((turned.lamps[0].place_m - (turn * lights.lamps[0].place_m + Vec3(0.3, -0.1, 2))).norm(), 1e-12);
  EXPECT_LT((turned.lamps[0].axis - turn * lights.lamps[0].axis).norm(), 1e-12);
  EXPECT_FALSE(turned.earth);
}

}  // namespace
}  // namespace lasso::mdat
