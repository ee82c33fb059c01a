#include "mdat/scene/orbit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kDeg = M_PI / 180;

Mat3 about_z(double a) { return Eigen::AngleAxisd(a, Vec3::UnitZ()).toRotationMatrix(); }

TEST(Orbit, HasThePeriodOfKeplersLaw) {
  VERIFIES("LASSO-SCN-008~1");
  const Orbit orbit({400e3, 0, 0});
  EXPECT_NEAR(orbit.period_s(), 2 * M_PI * std::sqrt(std::pow(6771008.8, 3) / 3.986004418e14), 1e-6);
  EXPECT_NEAR(orbit.period_s() / 60, 92.4, 0.1);
  EXPECT_NEAR(Orbit({35793e3, 0, 0}).period_s(), 86164, 60) << "geostationary: a sidereal day";
}

TEST(Orbit, LvlhHasItsAxesAlongTrackAgainstMomentumAndDown) {
  VERIFIES("LASSO-SCN-008~1");
  const Vec3 r(1, 0, 0), v(0, 1, 0);  // of the orbit's origin, in Hill axes
  const Mat3 R = q_hill_lvlh().toRotationMatrix();
  EXPECT_NEAR((R.col(0) - v).norm(), 0, 1e-15) << "V-bar";
  EXPECT_NEAR((R.col(1) + r.cross(v)).norm(), 0, 1e-15) << "against the angular momentum";
  EXPECT_NEAR((R.col(2) + r).norm(), 0, 1e-15) << "R-bar";
}

// The Sun stands still in an inertial frame in which the orbit is laid out by vectors: noon along a, motion towards b.
TEST(Orbit, TheSunStandsStillWhileTheFrameTurns) {
  VERIFIES("LASSO-SCN-009~1");
  test::Generator random(61);
  for (int trial = 0; trial < 30; ++trial) {
    const double beta = random.uniform(-1.5, 1.5), begin = random.uniform(-3, 3);
    const Orbit orbit({random.uniform(200e3, 36e6), beta, begin});
    const Mat3 noon_axes = random_attitude(random).toRotationMatrix();  // columns: noon, along the track at noon, angular momentum
    const Vec3 sun = noon_axes * Vec3(std::cos(beta), 0, std::sin(beta));
    const TimeUs t_us = random_time_us(random, -1e5, 1e5);
    const Mat3 hill = noon_axes * about_z(begin + 2 * M_PI * to_seconds(t_us) / orbit.period_s());
    ASSERT_NEAR((hill * orbit.sun_hill(t_us) - sun).norm(), 0, 1e-12);
    const Vec3 rate = (orbit.sun_hill(t_us + 100000) - orbit.sun_hill(t_us - 100000)) / 0.2;
    ASSERT_NEAR((rate - orbit.sun_rate_hill_radps(t_us)).norm(), 0, 1e-10);
  }
}

TEST(Orbit, BetaIsTheAngleBetweenTheSunAndTheOrbitPlane) {
  VERIFIES("LASSO-SCN-009~1");
  test::Generator random(62);
  for (int trial = 0; trial < 30; ++trial) {
    const double inclination = random.uniform(0, M_PI), node = random.uniform(-3, 3);
    const double ascension = random.uniform(-3, 3), declination = random.uniform(-0.41, 0.41);
    const Vec3 normal = about_z(node) * Eigen::AngleAxisd(inclination, Vec3::UnitX()).toRotationMatrix() * Vec3::UnitZ();
    const Vec3 sun(std::cos(declination) * std::cos(ascension), std::cos(declination) * std::sin(ascension), std::sin(declination));
    ASSERT_NEAR(beta_angle_rad(inclination, node, ascension, declination), M_PI / 2 - std::acos(normal.dot(sun)), 1e-9);
  }
}

// Rays towards points all over the Sun's disc, each asked whether it meets the Earth's sphere.
double share_by_rays(const Orbit& orbit, TimeUs t_us) {
  const Vec3 sun = orbit.sun_hill(t_us);
  const Vec3 u = Eigen::AngleAxisd(0.37, sun) * sun.unitOrthogonal(), w = sun.cross(u);
  const double radius = std::asin(kSunRadius_m / kSunDistance_m);
  const int cells = 200;
  int free = 0, all = 0;
  for (int i = -cells; i <= cells; ++i) {
    for (int j = -cells; j <= cells; ++j) {
      if (i * i + j * j > cells * cells) continue;
      const Vec3 ray = (sun + std::tan(radius) / cells * (i * u + j * w)).normalized();
      const double across_m = orbit.radius_m() * std::sqrt(ray.y() * ray.y() + ray.z() * ray.z());  // from the Earth's centre
      const bool met = ray.x() < 0 && across_m < kEarthRadius_m;
      free += met ? 0 : 1;
      ++all;
    }
  }
  return static_cast<double>(free) / all;
}

// Rings about the Sun's middle, each with the part of it that lies within the Earth's circle, by spherical trigonometry.
double share_by_rings(const Orbit& orbit, TimeUs t_us) {
  const double limb = std::asin(kEarthRadius_m / orbit.radius_m()), radius = std::asin(kSunRadius_m / kSunDistance_m);
  const double apart = std::acos(-orbit.sun_hill(t_us).x());
  const int rings = 4000;
  double covered = 0;
  for (int i = 0; i < rings; ++i) {
    const double ring = radius * (i + 0.5) / rings;
    const double cosine = (std::cos(limb) - std::cos(ring) * std::cos(apart)) / (std::sin(ring) * std::sin(apart));
    covered += std::acos(std::clamp(cosine, -1.0, 1.0)) / M_PI * std::sin(ring) * radius / rings;
  }
  return 1 - covered / (1 - std::cos(radius));
}

TEST(Orbit, PenumbraIsTheShareOfTheSunsDiscThatRaysSee) {
  VERIFIES("LASSO-SCN-010~1");
  for (const auto& [altitude_m, beta_deg] : {std::pair{370e3, 0.0}, {400e3, 65.0}, {540e3, -40.0}, {36e6, 5.0}}) {
    const Orbit orbit({altitude_m, beta_deg * kDeg, M_PI});  // midnight
    const double dark =
        std::acos(std::sqrt(altitude_m * (altitude_m + 2 * kEarthRadius_m)) / (orbit.radius_m() * std::cos(beta_deg * kDeg)));
    const auto edge_us = static_cast<TimeUs>(1e6 * dark / orbit.mean_motion_radps());
    int partial = 0;
    for (TimeUs t_us = edge_us - 200'000'000; t_us < edge_us + 200'000'000; t_us += 970'000) {
      const double share = orbit.sunlit_share(t_us);
      if (share <= 0 || share >= 1) continue;
      ++partial;
      ASSERT_NEAR(share, share_by_rays(orbit, t_us), 1e-3) << altitude_m;
      ASSERT_NEAR(share, share_by_rings(orbit, t_us), 1e-4) << altitude_m;
    }
    EXPECT_GE(partial, 8);
  }
}

// By the cylinder: the share of the orbit in eclipse is acos(sqrt(h^2 + 2 R h) / ((R + h) cos beta)) / pi; the cone's half-light is there.
TEST(Orbit, TheEclipsesShareIsTheClosedFormOfTheCylinder) {
  VERIFIES("LASSO-SCN-010~1");
  for (const double altitude_m : {250e3, 400e3, 1400e3}) {
    for (const double beta_deg : {-45.0, 0.0, 30.0, 40.0}) {
      const Orbit orbit({altitude_m, beta_deg * kDeg, 0.3});
      const double expected =
          std::acos(std::sqrt(altitude_m * altitude_m + 2 * kEarthRadius_m * altitude_m) / (orbit.radius_m() * std::cos(beta_deg * kDeg))) /
          M_PI;
      const int steps = 40000;
      int dark = 0;
      double lost = 0;
      for (int i = 0; i < steps; ++i) {
        const double share = orbit.sunlit_share(static_cast<TimeUs>(1e6 * orbit.period_s() * i / steps));
        dark += share < 0.5 ? 1 : 0;
        lost += 1 - share;
      }
      EXPECT_NEAR(static_cast<double>(dark) / steps, expected, 6e-5) << altitude_m << " " << beta_deg;
      EXPECT_NEAR(lost / steps, expected, 6e-5) << altitude_m << " " << beta_deg;
    }
  }
}

TEST(Orbit, NoEclipseWhereTheSunStandsHighAboveThePlane) {
  VERIFIES("LASSO-SCN-010~1");
  const double limit = std::asin(kEarthRadius_m / (kEarthRadius_m + 400e3));
  for (const double beta : {limit + 0.005, -limit - 0.005, M_PI / 2}) EXPECT_EQ(Orbit({400e3, beta, M_PI}).sunlit_share(0), 1);
  EXPECT_EQ(Orbit({400e3, limit - 0.005, M_PI}).sunlit_share(0), 0);
  EXPECT_NEAR(Orbit({400e3, limit, M_PI}).sunlit_share(0), 0.5, 1e-3);
}

TEST(Orbit, TheEarthShinesFromBelowByTheSunsHeightThere) {
  VERIFIES("LASSO-SCN-010~1");
  const Orbit orbit({400e3, 25 * kDeg, 0});
  const Earthshine noon = orbit.earthshine(0), night = orbit.earthshine(static_cast<TimeUs>(0.5e6 * orbit.period_s()));
  EXPECT_EQ(noon.direction_hill, Vec3(-1, 0, 0));
  EXPECT_NEAR(noon.half_angle_rad / kDeg, 70.2, 0.1);
  EXPECT_NEAR(noon.lit, std::cos(25 * kDeg), 1e-12);
  EXPECT_EQ(night.lit, 0);
}

TEST(Orbit, SaysAllThatIsWrongWithIt) {
  VERIFIES("LASSO-SCN-003~1");
  EXPECT_EQ(problems_of([] {
              Orbit({-5, 2, kNan}, {"scene.toml", 7, 1});
            }),
            "scene.toml:7:1: altitude: -5 m: is below the ground: expected metres above the Earth's mean radius, more than 0\n"
            "scene.toml:7:1: angle: nan: expected a finite angle from orbit noon\n"
            "scene.toml:7:1: beta: 2 rad: expected an elevation of the Sun above the orbit plane from -90 to 90 deg");
  EXPECT_EQ(problems_of([] {
              Orbit({2e9, kNan, 0});
            }),
            "scene: altitude: 2e+09 m: expected at most 1e9 m\n"
            "scene: beta: nan rad: expected an elevation of the Sun above the orbit plane from -90 to 90 deg");
  EXPECT_NE(problems_of([] { Orbit({kNan, 0, 0}); }), "");
}

}  // namespace
}  // namespace lasso::mdat::scene
