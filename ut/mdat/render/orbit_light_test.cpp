#include "mdat/render/orbit_light.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

scene::Orbit orbit_at(double angle_deg, double beta_deg) {
  scene::Orbit::Setup setup;
  setup.altitude_m = 400e3;
  setup.beta_rad = beta_deg * kRadPerDeg;
  setup.angle_rad = angle_deg * kRadPerDeg;
  return scene::Orbit(setup);
}

TEST(OrbitLight, AtNoonTheSunIsAboveAndTheEarthBelow) {
  VERIFIES("LASSO-PIC-015~1");
  const Lights lights = orbit_lights(orbit_at(0, 0), 0);
  EXPECT_LT((*lights.sun - Vec3(0, -1, 0)).norm(), 1e-9);
  EXPECT_LT((*lights.earth - Vec3(0, 1, 0)).norm(), 1e-9);
  EXPECT_EQ(lights.sun_share, 1);
  EXPECT_NEAR(std::sin(lights.earth_half_angle_rad), 6371.0088 / 6771.0088, 1e-9);
  EXPECT_NEAR(earth_radiance(lights), kEarthAlbedo * kSun_Wpm2 / kPi, 1e-6);
}

// Angles count from noon along the track: a quarter of the orbit later the sun stands behind a camera that looks along the track, and a
// sun north of the orbit plane stands at its left, where the orbit's angular momentum points.
TEST(OrbitLight, TheSunStandsWhereTheOrbitHasIt) {
  VERIFIES("LASSO-PIC-015~1");
  const Lights evening = orbit_lights(orbit_at(60, 0), 0);
  EXPECT_LT((*evening.sun - Vec3(0, -std::cos(kPi / 3), -std::sin(kPi / 3))).norm(), 1e-9);
  const Lights north = orbit_lights(orbit_at(0, 30), 0);
  EXPECT_LT((*north.sun - Vec3(-0.5, -std::cos(kPi / 6), 0)).norm(), 1e-9);
}

TEST(OrbitLight, MidnightIsDark) {
  VERIFIES("LASSO-PIC-015~1");
  const Lights lights = orbit_lights(orbit_at(180, 0), 0);
  EXPECT_EQ(lights.sun_share, 0);
  EXPECT_EQ(earth_radiance(lights), 0);
  const scene::Orbit orbit = orbit_at(0, 0);
  const auto half = static_cast<TimeUs>(5e5 * orbit.period_s());
  EXPECT_EQ(orbit_lights(orbit, half).sun_share, 0);
}

}  // namespace
}  // namespace lasso::mdat
