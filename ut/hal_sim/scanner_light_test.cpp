// Rays of a scanner whose detector sees light: 10^5 of each against the equations of its contract, by range, incidence and material.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hal_sim/scanner.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::ShapeMesh;

constexpr std::uint32_t kLightRays = 100000;
const Vec3 kAhead = Vec3(0.02, 0.05, 1).normalized();

class FixedSun final : public SunSource {
 public:
  explicit FixedSun(const Vec3& direction) : direction_(direction.normalized()) {}
  Sunlight at(TimeUs) const override { return {direction_, 1}; }

 private:
  Vec3 direction_;
};

// A wall of one material through the target's origin, turned about the sensor's x axis.
struct LitWall {
  LitWall(const LaserReflection& surface, double range_m, double incidence_rad)
      : motion({Pose{exp_so3(Vec3(incidence_rad, 0, 0)), Vec3(0, 0, range_m)}, Twist{}}, 0) {
    ShapeMesh mesh;
    mesh.quad(Vec3(-500, -500, 0), Vec3(500, -500, 0), Vec3(500, 500, 0), Vec3(-500, 500, 0));
    target = make_ray_caster(mesh.vertices, mesh.triangles, std::vector<LaserReflection>(2, surface));
    const Vec3 normal(0, -std::sin(incidence_rad), std::cos(incidence_rad));
    cosine = normal.dot(kAhead);
    range = range_m * normal.z() / cosine;
  }
  std::unique_ptr<RayCaster> target;
  ConstantTwist motion;
  double cosine, range;
};

ScannerModel lidar_with_detector() {
  ScannerModel model;
  model.sigma0_m = 0.01;
  model.sigma_k_per_m = 2e-6;
  model.range_min_m = 1;
  model.range_max_m = 400;
  model.detector.reference_electrons = 3000;
  model.detector.reference_range_m = 60;
  model.detector.reference_reflectance = 0.8;
  model.detector.noise_electrons = 40;
  model.detector.threshold_electrons = 240;
  model.detector.width_m = 0.3;
  return model;
}

struct Light {
  double hits = 0, invalid = 0, misses = 0, sigma_m = 0;  // shares of the rays
};
Light measured(const LitWall& wall, const ScannerModel& model) {
  const RaySimulator rays(*wall.target, wall.motion, model, 11);
  Light light;
  double sum2 = 0;
  for (std::uint32_t i = 0; i < kLightRays; ++i) {
    const RangeSample sample = rays.measure(i / 1000, i % 1000, kAhead, 0);
    (sample.state == RayState::kHit ? light.hits : sample.state == RayState::kMiss ? light.misses : light.invalid) += 1.0 / kLightRays;
    if (sample.state == RayState::kHit) sum2 += std::pow(static_cast<double>(sample.range_m) - wall.range, 2);
  }
  light.sigma_m = std::sqrt(sum2 / (light.hits * kLightRays));
  return light;
}

TEST(ScannerLight, NoiseAndReturnsFollowTheLinkBudgetByRangeIncidenceAndMaterial) {
  VERIFIES("LASSO-SIM-061~1 LASSO-SIM-062~1 LASSO-SIM-063~1");
  const ScannerModel model = lidar_with_detector();
  for (const LaserReflection& surface :
       {LaserReflection{0.75, 0.04, 0.5}, LaserReflection{0.18, 0.77, 0.18}, LaserReflection{0.4, 0.04, 0.35}}) {
    for (const auto& [range_m, incidence_rad] : {std::pair{60.0, 0.05}, std::pair{60.0, 0.9}, std::pair{150.0, 0.4}}) {
      const LitWall wall(surface, range_m, incidence_rad);
      const double signal = 3000 * backscatter(surface, wall.cosine) / 0.8 * std::pow(60 / wall.range, 2);
      const double noise = std::sqrt(signal + 1600);
      const double returned = 0.5 * std::erfc((240 - signal) / noise / std::sqrt(2));
      const double far_m = 2e-6 * std::pow(wall.range * kAhead.z(), 2);
      const double sigma_m = std::sqrt(1e-4 + far_m * far_m + std::pow(0.3 * noise / signal, 2));
      const Light light = measured(wall, model);
      EXPECT_NEAR(light.hits, returned, 0.05 * returned + 1e-4) << range_m << ' ' << incidence_rad;
      EXPECT_NEAR(light.misses, 1 - light.hits, 1e-9);
      if (returned > 0.02) {
        EXPECT_NEAR(light.sigma_m, sigma_m, 0.05 * sigma_m) << range_m << ' ' << incidence_rad;
      }
    }
  }
}

TEST(ScannerLight, AMirrorSaturatesAtRightAnglesAndIsNotSeenElsewhere) {
  VERIFIES("LASSO-SIM-061~1 LASSO-SIM-063~1");
  ScannerModel model = lidar_with_detector();
  model.detector.saturation_electrons = 60000;
  const LaserReflection mirror{0.01, 0.9, 0.05};
  EXPECT_NEAR(measured(LitWall(mirror, 60, 0), model).invalid, 1, 1e-9);
  EXPECT_GT(measured(LitWall(mirror, 60, 0.6), model).misses, 0.99);
}

TEST(ScannerLight, WithoutADetectorMaterialsAndTheSunChangeNoBit) {
  VERIFIES("LASSO-SIM-067~1");
  ScannerModel model = lidar_with_detector();
  model.detector = {};
  model.edge_mixing_m = 0.01;
  ScannerModel lit = model;
  lit.detector.sun = std::make_shared<FixedSun>(Vec3(0, -1, -1));
  lit.detector.bandpass_m = 1e-8;
  lit.detector.energy_J = 1e-6;
  const LitWall white({1, 0, 1}, 60, 0.3), mirror({0, 1, 0.05}, 60, 0.3);
  const RaySimulator dark_rays(*white.target, white.motion, model, 5), lit_rays(*mirror.target, mirror.motion, lit, 5);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const RangeSample a = dark_rays.measure(1, i, kAhead, 0), b = lit_rays.measure(1, i, kAhead, 0);
    EXPECT_EQ(a.range_m, b.range_m);
    EXPECT_EQ(a.state, b.state);
  }
}

ScannerModel in_sunlight(const Vec3& sun) {
  ScannerModel model = lidar_with_detector();
  model.detector.bandpass_m = 20e-9;
  model.detector.energy_J = 5e-8;
  model.detector.field_rad = 2e-3;
  model.detector.gate_s = 2e-7;
  model.detector.sun = std::make_shared<FixedSun>(sun);
  return model;
}

TEST(ScannerLight, SunlightOnTheSurfaceIsShotNoise) {
  VERIFIES("LASSO-SIM-066~1");
  const LaserReflection plain{0.5, 0, 1};
  const LitWall wall(plain, 100, 0.4);
  ScannerModel model = in_sunlight(Vec3(0, 0.3, -1));
  model.detector.threshold_electrons = 450;                    // so that there is no false return
  const Vec3 normal = Vec3(0, std::sin(0.4), -std::cos(0.4));  // towards the sensor
  const double lit = normal.dot(Vec3(0, 0.3, -1).normalized());
  const double background = sun_electrons(model.detector, lit * 0.5 / M_PI);
  const double signal = 3000 * 0.5 * wall.cosine / 0.8 * std::pow(60 / wall.range, 2);
  ASSERT_GT(background, signal);  // so that it shows
  const double noise = std::sqrt(signal + background + 1600);
  const double far_m = 2e-6 * std::pow(wall.range * kAhead.z(), 2);
  const Light light = measured(wall, model);
  const double expected_m = std::sqrt(1e-4 + far_m * far_m + std::pow(0.3 * noise / signal, 2));
  EXPECT_NEAR(light.sigma_m, expected_m, 0.05 * expected_m);
}

TEST(ScannerLight, AShadowIsAsDarkAsNoSun) {
  VERIFIES("LASSO-SIM-066~1 LASSO-SIM-067~1");
  const LitWall wall({0.5, 0, 1}, 100, 0.4);
  const Light behind = measured(wall, in_sunlight(Vec3(0, 0, 1)));  // shines on the other side
  ScannerModel dark = in_sunlight(Vec3(0, 0, 1));
  dark.detector.sun = nullptr;
  const Light none = measured(wall, dark);
  EXPECT_EQ(behind.hits, none.hits);
  EXPECT_EQ(behind.sigma_m, none.sigma_m);

  // A screen between the Sun and the wall.
  ShapeMesh screen;
  screen.quad(Vec3(-30, 40, 70), Vec3(30, 40, 70), Vec3(30, 100, 70), Vec3(-30, 100, 70));
  const ConstantTwist still({Pose{}, Twist{}}, 0);
  const OtherBodies others = {
      {std::shared_ptr<const RayCaster>(make_ray_caster(screen.vertices, screen.triangles)), std::make_shared<ConstantTwist>(still)}};
  const RaySimulator shaded(*wall.target, wall.motion, in_sunlight(Vec3(0, 2, -1)), 11, others);
  const RaySimulator unlit(*wall.target, wall.motion, dark, 11, others);
  const RaySimulator lit(*wall.target, wall.motion, in_sunlight(Vec3(0, 2, -1)), 11);
  int different = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(shaded.measure(0, i, kAhead, 0).range_m, unlit.measure(0, i, kAhead, 0).range_m);
    different += lit.measure(0, i, kAhead, 0).range_m != unlit.measure(0, i, kAhead, 0).range_m ? 1 : 0;
  }
  EXPECT_GT(different, 900);
}

TEST(ScannerLight, NearTheSunNothingIsSeen) {
  VERIFIES("LASSO-SIM-066~1");
  const LitWall wall({0.5, 0, 1}, 100, 0.4);
  ScannerModel model = in_sunlight(kAhead);
  model.detector.saturation_electrons = 1e5;
  model.detector.glare_per_sr = 1e-5;
  ShapeMesh small;  // that does not hide the Sun
  small.quad(Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0));
  const auto target = make_ray_caster(small.vertices, small.triangles);
  const ConstantTwist motion({Pose{Quat::Identity(), Vec3(0, 0, 50)}, Twist{}}, 0);
  const RaySimulator rays(*target, motion, model, 3);
  EXPECT_EQ(rays.measure(0, 0, kAhead, 0).state, RayState::kInvalid);
  EXPECT_EQ(rays.measure(0, 0, Vec3(0.3, 0, 1).normalized(), 0).state, RayState::kMiss);
}

// Two walls, one behind the other, whose edge is in the footprint.
TEST(ScannerLight, OfTwoSurfacesTheSensorsRuleTells) {
  VERIFIES("LASSO-SIM-065~1");
  ShapeMesh mesh;
  mesh.quad(Vec3(-50, -50, 0), Vec3(0, -50, 0), Vec3(0, 50, 0), Vec3(-50, 50, 0));
  mesh.quad(Vec3(-50, -50, 5), Vec3(50, -50, 5), Vec3(50, 50, 5), Vec3(-50, 50, 5));
  const std::vector<LaserReflection> materials = {{0.2, 0, 1}, {0.2, 0, 1}, {0.8, 0, 1}, {0.8, 0, 1}};
  const auto target = make_ray_caster(mesh.vertices, mesh.triangles, materials);
  const ConstantTwist motion({Pose{Quat::Identity(), Vec3(0, 0, 40)}, Twist{}}, 0);
  ScannerModel model = lidar_with_detector();
  model.sigma0_m = model.sigma_k_per_m = 0;
  model.edge_mixing_m = 0.05;
  model.detector.threshold_electrons = 0;
  model.detector.noise_electrons = 0;
  model.detector.reference_electrons = 1e9;  // noise is no matter
  const Vec3 edge = Vec3(-0.0005, 0, 1).normalized();
  constexpr int kEdgeRays = 20000;
  const auto near_share = [&](Returns returns) {
    model.detector.returns = returns;
    const RaySimulator rays(*target, motion, model, 2);
    int count = 0;
    for (std::uint32_t i = 0; i < kEdgeRays; ++i) {
      const RangeSample sample = rays.measure(0, i, edge, 0);
      EXPECT_EQ(sample.state, RayState::kHit);
      count += sample.range_m < 41 ? 1 : 0;
    }
    return static_cast<double>(count) / kEdgeRays;
  };
  EXPECT_EQ(near_share(Returns::kFirst), 1);
  EXPECT_LT(near_share(Returns::kLast), 1e-3);
  // The share u of the far wall is uniform; it is stronger where u 0.8 / 45^2 > (1 - u) 0.2 / 40^2.
  const double strength = (0.8 / 45 / 45) / (0.2 / 40 / 40);
  EXPECT_NEAR(near_share(Returns::kStrongest), 1 / (1 + strength), 0.05 / (1 + strength));
}

// A cloud between the sensor and a wall, about the beam.
struct CloudedWall {
  explicit CloudedWall(double depth) : wall({0.5, 0, 1}, 60, 0.2), extinction_per_m(depth / 8) {
    ScatterVolume volume;
    volume.radius_m = volume.core_m = 4;
    volume.extinction_per_m = extinction_per_m;
    const Pose here{Quat::Identity(), 30 * kAhead};
    others = {{nullptr, std::make_shared<ConstantTwist>(TruthState{here, Twist{}}, 0), std::make_shared<const ScatterVolume>(volume)}};
  }
  std::vector<RangeSample> samples(const ScannerModel& model) const {
    const RaySimulator rays(*wall.target, wall.motion, model, 6, others);
    std::vector<RangeSample> result;
    for (std::uint32_t i = 0; i < kLightRays; ++i) result.push_back(rays.measure(i / 1000, i % 1000, kAhead, 0));
    return result;
  }
  LitWall wall;
  double extinction_per_m;
  OtherBodies others;
};

template <class Is>
double share_where(const std::vector<RangeSample>& samples, Is is) {
  return static_cast<double>(std::count_if(samples.begin(), samples.end(), is)) / static_cast<double>(samples.size());
}

TEST(ScannerLight, WithoutADetectorACloudTakesSinglePhotonsByBeerAndLambert) {
  VERIFIES("LASSO-SIM-068~1");
  const CloudedWall clouded(0.7);
  ScannerModel model;
  model.range_max_m = 400;
  const std::vector<RangeSample> samples = clouded.samples(model);
  const double from_cloud = share_where(samples, [](const RangeSample& s) { return s.state == RayState::kHit && s.range_m < 40; });
  const double from_wall = share_where(samples, [](const RangeSample& s) { return s.state == RayState::kHit && s.range_m > 40; });
  EXPECT_NEAR(from_cloud, 1 - std::exp(-0.7), 0.05 * (1 - std::exp(-0.7)));
  EXPECT_NEAR(from_wall, std::exp(-1.4), 0.05 * std::exp(-1.4));
  EXPECT_NEAR(share_where(samples, [](const RangeSample& s) { return s.state == RayState::kMiss; }), 1 - from_cloud - from_wall, 1e-9);
  const double first_half = share_where(samples, [](const RangeSample& s) { return s.state == RayState::kHit && s.range_m < 30; });
  EXPECT_NEAR(first_half, 1 - std::exp(-0.35), 0.05 * (1 - std::exp(-0.35)));
}

TEST(ScannerLight, WithADetectorWhatIsBehindACloudReturnsLess) {
  VERIFIES("LASSO-SIM-068~1");
  const CloudedWall clouded(0.7);
  ScannerModel model = lidar_with_detector();
  model.detector.returns = Returns::kLast;
  model.detector.reference_electrons = 1800;
  const double signal = 1800 * 0.5 * clouded.wall.cosine / 0.8 * std::pow(60 / clouded.wall.range, 2) * std::exp(-1.4);
  const double expected = 0.5 * std::erfc((240 - signal) / std::sqrt(2 * (signal + 1600)));
  ASSERT_GT(expected, 0.2);
  ASSERT_LT(expected, 0.8);
  const auto is_of_wall = [](const RangeSample& s) { return s.state == RayState::kHit && s.range_m > 40; };
  EXPECT_NEAR(share_where(clouded.samples(model), is_of_wall), expected, 0.05 * expected);
}

TEST(ScannerLight, ACloudIsSeenAsFarAsItReturnsEnough) {
  VERIFIES("LASSO-SIM-068~1");
  const CloudedWall clouded(0.7);
  ScannerModel model = lidar_with_detector();
  model.detector.returns = Returns::kFirst;
  const auto is_of_cloud = [](const RangeSample& s) { return s.state == RayState::kHit && s.range_m < 40; };
  EXPECT_LT(share_where(clouded.samples(model), is_of_cloud), 1e-3);  // far below the threshold
  model.detector.reference_electrons = 1e6;                           // a stronger laser
  EXPECT_NEAR(share_where(clouded.samples(model), is_of_cloud), 1 - std::exp(-0.7), 0.05 * (1 - std::exp(-0.7)));
}

}  // namespace
}  // namespace lasso::sim
