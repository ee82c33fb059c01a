#include "mdat/availability/light_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A sensor that stands behind the origin of the orbit and looks along the track.
SceneRun run_behind(const scene::Orbit::Setup& setup) {
  scene::Node sensor;
  sensor.name = "head";
  sensor.parent = "root";
  sensor.T_parent_base.p = Vec3(0, -5, 0);
  sensor.T_parent_base.q = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());
  return {scene::Tree("root", {sensor}), 0, 1, {}, nullptr, 0, 0, {}, {}, {}, scene::Orbit(setup), {}};
}

// In the plane of the orbit the Sun is up at noon, behind at sunset (a quarter of an orbit later), before the sensor at sunrise.
TEST(LightPhase, TheSunStandsWhereTheOrbitHasIt) {
  VERIFIES("LASSO-AVA-001~1");
  const SceneRun run = run_behind({400e3, 0, 0});
  const double period_s = run.orbit->period_s();
  const auto off_deg = [&](double turns) { return light_at(run, to_us(turns * period_s)).sun_off_rad / kRadPerDeg; };
  EXPECT_NEAR(off_deg(0), 90, 0.01);
  EXPECT_NEAR(off_deg(0.25), 180, 0.01);
  EXPECT_NEAR(off_deg(0.2), 162, 0.01);
  EXPECT_NEAR(off_deg(0.75), 0, 0.01);
  EXPECT_NEAR(light_at(run, to_us(0.1 * period_s)).earth_lit, std::cos(36 * kRadPerDeg), 1e-6);
  EXPECT_EQ(light_at(run, to_us(0.5 * period_s)).sun_share, 0);
  EXPECT_EQ(light_at(run, to_us(0.5 * period_s)).earth_lit, 0);
}

// Sunset is where the line to the Sun grazes the Earth: 90 deg and acos(R / r) past noon, 110 deg at 400 km.
TEST(LightPhase, DayEndsWhereTheGroundDimsAndEclipseBeginsWhereTheSunSets) {
  VERIFIES("LASSO-AVA-001~1");
  const SceneRun run = run_behind({400e3, 0, 0});
  const auto phase = [&](double angle_deg) { return phase_of(light_at(run, to_us(angle_deg / 360 * run.orbit->period_s()))); };
  const double sunset_deg = 90 + std::acos(scene::kEarthRadius_m / run.orbit->radius_m()) / kRadPerDeg;
  const double dim_deg = std::acos(kEarthDim) / kRadPerDeg;
  EXPECT_EQ(phase(dim_deg - 0.1), LightPhase::kDay);
  EXPECT_EQ(phase(dim_deg + 0.1), LightPhase::kTerminator);
  EXPECT_EQ(phase(sunset_deg), LightPhase::kTerminator) << "half of the Sun is seen";
  EXPECT_EQ(phase(sunset_deg + 0.5), LightPhase::kEclipse);
  EXPECT_EQ(phase(360 - sunset_deg - 0.5), LightPhase::kEclipse);
  EXPECT_EQ(phase(360 - sunset_deg + 0.5), LightPhase::kTerminator);
  EXPECT_EQ(phase(360 - dim_deg + 0.1), LightPhase::kDay);
}

TEST(LightPhase, HasNamesAndNeedsAnOrbit) {
  VERIFIES("LASSO-AVA-001~1");
  EXPECT_STREQ(phase_name(LightPhase::kDay), "day");
  EXPECT_STREQ(phase_name(LightPhase::kTerminator), "terminator");
  EXPECT_STREQ(phase_name(LightPhase::kEclipse), "eclipse");
  for (const LightPhase phase : kLightPhases) EXPECT_NE(std::string(phase_meaning(phase)).find("Sun"), std::string::npos);
  SceneRun run = run_behind({400e3, 0, 0});
  run.orbit.reset();
  EXPECT_THROW(static_cast<void>(light_at(run, 0)), InputError);
}

}  // namespace
}  // namespace lasso::mdat
