// Statistics of the simulated flash LIDAR against its equations, by sums of Poisson's probabilities of their own.
#include "hal_sim/flash_lidar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "fsw/sense/pixel_selector.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::ShapeMesh;

// A plane through (0, 0, range), turned about the sensor's x axis; what of it is beside `from_x_m` is not there.
struct FlashPlane {
  std::unique_ptr<RayCaster> surface;
  ConstantTwist motion;

  explicit FlashPlane(double range_m, double incidence_rad = 0, double from_x_m = -0.4, double half_m = 0.4,
                      const std::vector<LaserReflection>& reflections = {})
      : surface(make(from_x_m, half_m, reflections)), motion({Pose{exp_so3(Vec3(incidence_rad, 0, 0)), Vec3(0, 0, range_m)}, Twist{}}, 0) {}
  static std::unique_ptr<RayCaster> make(double from_x_m, double half_m, const std::vector<LaserReflection>& reflections) {
    ShapeMesh mesh;
    mesh.quad(Vec3(from_x_m, -half_m, 0), Vec3(half_m, -half_m, 0), Vec3(half_m, half_m, 0), Vec3(from_x_m, half_m, 0));
    return make_ray_caster(mesh.vertices, mesh.triangles, reflections);
  }
};

// A field so narrow that range and incidence are the same all over it.
ScannerModel narrow_field() {
  ScannerModel scanner;
  scanner.fov_half_x_rad = scanner.fov_half_y_rad = 1e-3;
  scanner.range_min_m = 1;
  scanner.range_max_m = 100;
  return scanner;
}

FlashModel large_model() {
  FlashModel model;
  model.columns = model.rows = 256;
  model.dead_share = 0;
  return model;
}

ScanPlan whole_field(const ScannerModel& scanner, std::uint32_t scan_id) {
  ScanPlan plan;
  plan.scan_id = scan_id;
  plan.half_x = std::tan(scanner.fov_half_x_rad);
  plan.half_y = std::tan(scanner.fov_half_y_rad);
  return plan;
}

std::vector<RangeSample> flash_frame(FlashLidar& lidar, const ScanPlan& plan) {
  EXPECT_EQ(lidar.start(plan, 1000), Status::kOk);
  std::vector<RangeSample> pixels;
  RangeSample out[kMaxSamplesPerPoll];
  for (int i = 0; i < 1000; ++i) {
    const PixelPoll piece = lidar.poll(1000, Span<RangeSample>(out));
    EXPECT_EQ(piece.t_us, 1000) << "one time for all";
    pixels.insert(pixels.end(), out, out + piece.count);
    if (piece.complete) return pixels;
  }
  ADD_FAILURE() << "never complete";
  return pixels;
}

double poisson_term(double mean, int count) { return std::exp(count * std::log(mean) - mean - std::lgamma(count + 1.0)); }

double at_least(double mean, int threshold) {
  double sum = 0;
  for (int count = threshold; count < 5000; ++count) sum += poisson_term(mean, count);
  return sum;
}

// Mean of 1 / n over the counts n that are detected.
double mean_inverse(double mean, int threshold) {
  double sum = 0;
  for (int count = threshold; count < 5000; ++count) sum += poisson_term(mean, count) / count;
  return sum / at_least(mean, threshold);
}

struct PixelTally {
  double hits = 0, misses = 0, invalid = 0, sum_m = 0, sum2_m2 = 0;

  double mean_m() const { return sum_m / hits; }
  double sigma_m() const { return std::sqrt(sum2_m2 / hits - mean_m() * mean_m()); }
};

// Two frames: 131,072 pixels. Errors are against the range of each pixel's own ray to the plane.
PixelTally pixel_tally(const FlashPlane& plane, const ScannerModel& scanner, const FlashModel& model, double range_m,
                       double incidence_rad = 0) {
  FlashLidar lidar(*plane.surface, plane.motion, scanner, model, 42);
  const Vec3 normal(0, -std::sin(incidence_rad), std::cos(incidence_rad));
  PixelTally tally;
  for (std::uint32_t scan = 0; scan < 2; ++scan) {
    for (const RangeSample& pixel : flash_frame(lidar, whole_field(scanner, scan))) {
      tally.hits += pixel.state == RayState::kHit ? 1 : 0;
      tally.misses += pixel.state == RayState::kMiss ? 1 : 0;
      tally.invalid += pixel.state == RayState::kInvalid ? 1 : 0;
      if (pixel.state != RayState::kHit) continue;
      const Vec3 ray(static_cast<double>(pixel.direction[0]), static_cast<double>(pixel.direction[1]),
                     static_cast<double>(pixel.direction[2]));
      const double error_m = static_cast<double>(pixel.range_m) - range_m * normal.z() / normal.dot(ray);
      tally.sum_m += error_m;
      tally.sum2_m2 += error_m * error_m;
    }
  }
  return tally;
}

TEST(FlashLidar, RangeNoiseAndDetectionAreThoseOfThePhotonsThatComeBack) {
  VERIFIES("LASSO-SIM-050~1");
  FlashModel model = large_model();
  model.background = 0.2;
  model.threshold = 8;  // that the background reaches in none of 10^9 bins
  const struct {
    double range_m, incidence_rad, reflectance;
  } cases[] = {{5, 0, 0.5}, {20, 0, 0.5}, {60, 0, 0.5}, {80, 0, 0.5}, {60, 1, 0.5}, {20, 0.7, 0.1}, {40, 1.2, 0.9}};
  for (const auto& at : cases) {
    model.reflectance = at.reflectance;
    const FlashPlane plane(at.range_m, at.incidence_rad);
    const PixelTally tally = pixel_tally(plane, narrow_field(), model, at.range_m, at.incidence_rad);
    const double photons = 400 * std::pow(10 / at.range_m, 2) * (at.reflectance / 0.5) * std::cos(at.incidence_rad);
    const double detected = at_least(photons + 0.2, 8);
    const double all = tally.hits + tally.misses;
    ASSERT_EQ(all, 2 * 65536);
    EXPECT_NEAR(tally.hits / all, detected, 0.05 * std::min(detected, 1 - detected) + 1e-3) << at.range_m;
    const double share = photons / (photons + 0.2);
    const double one_m2 = share * 0.15 * 0.15 + (1 - share) * 0.6 * 0.6 / 12;
    const double sigma_m = std::sqrt(1e-4 + one_m2 * mean_inverse(photons + 0.2, 8));
    EXPECT_NEAR(tally.sigma_m() / sigma_m, 1, 0.05) << at.range_m;
    EXPECT_NEAR(tally.mean_m(), 0, 5 * sigma_m / std::sqrt(tally.hits) + 2e-4 * at.range_m) << at.range_m;
  }
}

// The backscatter as docs/sensors.md states it. A material counts where the model says so.
TEST(FlashLidar, RangeNoiseAndDetectionFollowTheMaterial) {
  VERIFIES("LASSO-SIM-070~1");
  FlashModel model = large_model();
  model.background = 0.2;
  model.threshold = 8;
  const LaserReflection cells{0.05, 0.10, 0.06}, paint{0.75, 0.04, 0.50}, foil{0.18, 0.77, 0.22};
  const struct {
    const LaserReflection* surface;
    double range_m, incidence_rad;
  } cases[] = {{&paint, 60, 0}, {&foil, 60, 0.3}, {&cells, 20, 0.9}};
  for (const auto& at : cases) {
    const FlashPlane plane(at.range_m, at.incidence_rad, -0.4, 0.4, {*at.surface, *at.surface});
    for (const bool materials : {true, false}) {
      model.materials = materials;
      const PixelTally tally = pixel_tally(plane, narrow_field(), model, at.range_m, at.incidence_rad);
      const double c2 = std::pow(std::cos(at.incidence_rad), 2), a2 = at.surface->roughness * at.surface->roughness;
      const double lobe = at.surface->specular * a2 / (4 * std::pow((a2 - 1) * c2 + 1, 2) * std::sqrt(c2 + a2 * (1 - c2)));
      const double returned = materials ? at.surface->diffuse * std::sqrt(c2) + lobe : 0.5 * std::sqrt(c2);
      const double photons = 400 * std::pow(10 / at.range_m, 2) * returned / 0.5;
      const double detected = at_least(photons + 0.2, 8);
      EXPECT_NEAR(tally.hits / (2 * 65536), detected, 0.05 * std::min(detected, 1 - detected) + 1e-3) << at.range_m << materials;
      const double share = photons / (photons + 0.2);
      const double one_m2 = share * 0.15 * 0.15 + (1 - share) * 0.6 * 0.6 / 12;
      EXPECT_NEAR(tally.sigma_m() / std::sqrt(1e-4 + one_m2 * mean_inverse(photons + 0.2, 8)), 1, 0.05) << at.range_m << materials;
    }
  }
}

TEST(FlashLidar, RangeNoiseOfFewPhotonsIsThatOfTheCountsThatWereDetected) {
  VERIFIES("LASSO-SIM-050~1");
  FlashModel model = large_model();
  model.background = 0;
  for (const double incidence_rad : {0.0, 1.0}) {
    const FlashPlane plane(60, incidence_rad);
    const PixelTally tally = pixel_tally(plane, narrow_field(), model, 60, incidence_rad);
    const double photons = 400.0 / 36 * std::cos(incidence_rad);
    const double sigma_m = std::sqrt(1e-4 + 0.15 * 0.15 * mean_inverse(photons, 5));
    EXPECT_NEAR(tally.sigma_m() / sigma_m, 1, 0.05);
    EXPECT_NEAR(tally.misses / (tally.hits + tally.misses), 1 - at_least(photons, 5), 0.05 * (1 - at_least(photons, 5)));
  }
}

TEST(FlashLidar, TheBackgroundPassesForReturnsAsOftenAsItsCountsReachTheThreshold) {
  VERIFIES("LASSO-SIM-051~1");
  FlashModel model = large_model();
  model.background = 0.6;
  model.threshold = 5;
  const FlashPlane beside(50, 0, 0.39);  // nothing is in the field
  const PixelTally tally = pixel_tally(beside, narrow_field(), model, 50);
  const double bins = 99 / 0.6;
  const double expected = 1 - std::pow(1 - at_least(0.6, 5), bins);
  ASSERT_GT(expected, 0.02);
  EXPECT_NEAR(tally.hits / (2 * 65536), expected, 0.05 * expected);
  EXPECT_EQ(tally.invalid, 0);
}

TEST(FlashLidar, DeadPixelsMakeNoStatementAndAreTheSameInEachFrame) {
  VERIFIES("LASSO-SIM-052~1");
  FlashModel model = large_model();
  model.dead_share = 0.1;
  model.background = 0;
  const FlashPlane plane(10);
  FlashLidar lidar(*plane.surface, plane.motion, narrow_field(), model, 7);
  const auto first = flash_frame(lidar, whole_field(narrow_field(), 0)), second = flash_frame(lidar, whole_field(narrow_field(), 1));
  int dead = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].state == RayState::kInvalid, second[i].state == RayState::kInvalid);
    dead += first[i].state == RayState::kInvalid ? 1 : 0;
  }
  EXPECT_NEAR(dead / 65536.0, 0.1, 0.005);
  EXPECT_NE(first[100].range_m, second[100].range_m) << "the noise is not";
  const FlashPlane near(0.9);
  FlashLidar saturated(*near.surface, near.motion, narrow_field(), model, 7);
  EXPECT_EQ(flash_frame(saturated, whole_field(narrow_field(), 0))[5].state, RayState::kInvalid);
}

// The contour cuts the pixels of a column: three quarters of their field are beside the surface, or one.
TEST(FlashLidar, APixelOnAContourHasTheShareOfPhotonsThatItsFieldHas) {
  VERIFIES("LASSO-SIM-053~1");
  FlashModel model = large_model();
  model.background = 0;
  model.photons_at_10m = 12;
  const double pitch_m = 10 * 2 * std::tan(1e-3) / 256;
  const FlashPlane plane(10, 0, 0.5 * pitch_m);  // the right halves of column 128, and all columns beyond
  FlashLidar lidar(*plane.surface, plane.motion, narrow_field(), model, 3);
  double cut = 0, whole = 0;
  for (std::uint32_t scan = 0; scan < 8; ++scan) {
    const std::vector<RangeSample> pixels = flash_frame(lidar, whole_field(narrow_field(), scan));
    for (std::size_t row = 0; row < 256; ++row) {
      EXPECT_EQ(pixels[row * 256 + 127].state, RayState::kMiss);
      cut += pixels[row * 256 + 128].state == RayState::kHit ? 1 : 0;
      whole += pixels[row * 256 + 129].state == RayState::kHit ? 1 : 0;
    }
  }
  EXPECT_NEAR(whole / 2048, at_least(12, 5), 0.05 * at_least(12, 5));
  EXPECT_NEAR(cut / 2048, at_least(6, 5), 0.05 * at_least(6, 5));
}

// Behind the cut surface is another one, by less than a bin, or by more.
TEST(FlashLidar, APixelAcrossAStepReturnsARangeBetweenOrTheStrongerReturn) {
  VERIFIES("LASSO-SIM-053~1");
  FlashModel model = large_model();
  model.background = 0;
  model.photons_at_10m = 1e6;
  model.jitter_m = 0;
  const double pitch_m = 10 * 2 * std::tan(1e-3) / 256;
  for (const double step_m : {0.3, 3.0}) {
    const FlashPlane front(10, 0, 0.5 * pitch_m);
    OtherBodies others;
    others.push_back({FlashPlane::make(-0.4, 0.4, {}),
                      std::make_shared<ConstantTwist>(TruthState{Pose{Quat::Identity(), Vec3(0, 0, 10 + step_m)}, Twist{}}, 0)});
    FlashLidar lidar(*front.surface, front.motion, narrow_field(), model, 3, others);
    const std::vector<RangeSample> pixels = flash_frame(lidar, whole_field(narrow_field(), 0));
    double sum_m = 0;
    for (std::size_t row = 0; row < 256; ++row) sum_m += static_cast<double>(pixels[row * 256 + 128].range_m) / 256;
    const double front_photons = 1, back_photons = std::pow(10 / (10 + step_m), 2);
    const double mixed_m = (front_photons * 10 + back_photons * (10 + step_m)) / (front_photons + back_photons);
    EXPECT_NEAR(sum_m, step_m < model.bin_m() ? mixed_m : 10, 1e-4);
    EXPECT_NEAR(static_cast<double>(pixels[127].range_m), 10 + step_m, 1e-3);
  }
}

TEST(FlashLidar, SaysHowMuchLargerTheNoiseOfAPixelIsThanStated) {
  const FlashPlane plane(50, 1.2);
  FlashModel model = large_model();
  model.stated_sigma0_m = 0.03;
  model.stated_sigma_k_per_m = 0;
  FlashLidar lidar(*plane.surface, plane.motion, narrow_field(), model, 3);
  double hits = 0, normalised2 = 0;
  for (const RangeSample& pixel : flash_frame(lidar, whole_field(narrow_field(), 0))) {
    if (pixel.state != RayState::kHit) continue;
    const Vec3 normal(0, -std::sin(1.2), std::cos(1.2));
    const Vec3 ray(static_cast<double>(pixel.direction[0]), static_cast<double>(pixel.direction[1]),
                   static_cast<double>(pixel.direction[2]));
    const double error_m = static_cast<double>(pixel.range_m) - 50 * normal.z() / normal.dot(ray);
    if (std::abs(error_m) > 2) continue;  // a false return
    ++hits;
    normalised2 += std::pow(error_m / (0.03 * static_cast<double>(pixel.sigma_factor)), 2);
  }
  EXPECT_GT(hits, 10000);
  EXPECT_NEAR(normalised2 / hits, 1, 0.05);
}

TEST(FlashLidar, AnIdealOneMeasuresItsMiddleRaysExactlyAndOnlyInTheWindow) {
  ScannerModel scanner = narrow_field();
  scanner.fov_half_x_rad = scanner.fov_half_y_rad = 0.2;
  FlashModel model = large_model();
  model.ideal = true;
  model.dead_share = 0.5;
  const FlashPlane plane(10, 0.3, -20, 20);
  FlashLidar lidar(*plane.surface, plane.motion, scanner, model, 3);
  ScanPlan plan = whole_field(scanner, 0);
  plan.half_x = 0.1;
  plan.half_y = 0.05;
  plan.center_x = 0.03;
  const std::vector<RangeSample> pixels = flash_frame(lidar, plan);
  const double pitch = 2 * std::tan(0.2) / 256;
  EXPECT_NEAR(lidar.pitch().x, pitch, 1e-12);
  EXPECT_NEAR(static_cast<double>(pixels.size()), 0.2 / pitch * 0.1 / pitch, 150);
  for (const RangeSample& pixel : pixels) {
    const Vec3 normal(0, -std::sin(0.3), std::cos(0.3));
    const Vec3 ray(static_cast<double>(pixel.direction[0]), static_cast<double>(pixel.direction[1]),
                   static_cast<double>(pixel.direction[2]));
    ASSERT_NEAR(static_cast<double>(pixel.range_m), 10 * normal.z() / normal.dot(ray), 2e-5);
    ASSERT_LE(std::abs(ray.x() / ray.z() - 0.03), 0.1 + 1e-6);
  }
  PixelSelector* selector = new PixelSelector(lidar);
  EXPECT_EQ(selector->start(plan, 2000), Status::kOk);
  RangeSample out[kMaxSamplesPerPoll];
  SensorPoll poll = selector->poll(2000, Span<RangeSample>(out));
  while (poll.count == 0) poll = selector->poll(2000, Span<RangeSample>(out));
  EXPECT_TRUE(std::none_of(out, out + poll.count, [](const RangeSample& sample) { return sample.state != RayState::kHit; }));
  delete selector;
}

TEST(FlashLidar, RefusesWhatItCannotDo) {
  const FlashPlane plane(10);
  FlashLidar lidar(*plane.surface, plane.motion, narrow_field(), large_model(), 3);
  RangeSample out[kMaxSamplesPerPoll];
  EXPECT_EQ(lidar.poll(0, Span<RangeSample>(out)).status, Status::kNoData);
  ScanPlan plan = whole_field(narrow_field(), 0);
  plan.center_x = 0.001;
  EXPECT_EQ(lidar.start(plan, 0), Status::kBadValue) << "beside the field";
  plan.center_x = 0;
  EXPECT_EQ(lidar.start(plan, 1000), Status::kOk);
  EXPECT_EQ(lidar.start(plan, 1000), Status::kBusy);
  EXPECT_EQ(lidar.poll(999, Span<RangeSample>(out)).count, 0U) << "not yet";
  lidar.abort();
  EXPECT_EQ(lidar.poll(1000, Span<RangeSample>(out)).status, Status::kNoData);
  FlashModel wrong = large_model();
  wrong.rows = 257;
  try {
    FlashLidar(*plane.surface, plane.motion, narrow_field(), wrong, 3);
    ADD_FAILURE() << "more pixels than it can have";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "flash LIDAR: rows is 257, expected 8 to 256");
  }
}

TEST(Poisson, HasItsMeanAndVarianceOnBothSidesOfTheNormalDistribution) {
  for (const double mean : {0.05, 0.7, 8.0, 49.9, 50.1, 900.0}) {
    Random random(99);
    double sum = 0, sum2 = 0;
    constexpr int kDraws = 100000;
    for (int i = 0; i < kDraws; ++i) {
      const double count = poisson(random, mean);
      sum += count;
      sum2 += count * count;
    }
    EXPECT_NEAR(sum / kDraws, mean, 5 * std::sqrt(mean / kDraws)) << mean;
    EXPECT_NEAR((sum2 / kDraws - std::pow(sum / kDraws, 2)) / mean, 1, 0.05) << mean;
  }
}

TEST(DetectionProbability, IsThatOfPoissonsDistribution) {
  for (const double mean : {0.05, 0.6, 5.0, 20.0, 300.0}) {
    for (const int threshold : {1, 5, 20}) EXPECT_NEAR(detection_probability(mean, threshold), at_least(mean, threshold), 1e-12);
  }
}

}  // namespace
}  // namespace lasso::sim
