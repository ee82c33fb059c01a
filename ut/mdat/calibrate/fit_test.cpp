#include "mdat/calibrate/fit.hpp"

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kNoise = 1e-3 / 9;  // k: 1 mm at 3 m

lcs::Calibration design() {
  lcs::Calibration design;
  design.serial = 7;
  return design;
}

lcs::Calibration device() {
  lcs::Calibration device = design();
  device.focal_length_m = 0.0812;
  device.baseline_m = 0.2013;
  device.angle_x_offset_rad = 0.004;
  device.peak_per_K = 2e-5;
  device.residual[4] = 0.002;
  return device;
}

std::vector<RawPoint> recording() {
  PlaneRun run;
  run.depth_min_m = 2;
  run.depth_max_m = 2.2;
  run.sigma_k_per_m = kNoise;
  run.rays = 100;
  run.seed = 11;
  return simulate_planes(device(), run);
}

// Each n-th point is of something before or behind the plane, 0.3 1/m in inverse depth: beside the volume of all planes.
std::vector<RawPoint> with_strangers(std::vector<RawPoint> points, std::size_t n) {
  for (std::size_t i = 0; i < points.size(); i += n) points[i].peak += (i / n) % 2 == 0 ? 0.06 : -0.06;
  return points;
}

std::string refusal_of(const std::vector<RawPoint>& points, int max_evaluations, double sigma_k_per_m = kNoise) {
  try {
    fit_calibration(design(), points, sigma_k_per_m, max_evaluations);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Fit, UsesEveryPointOfACleanRecording) {
  VERIFIES("LASSO-GND-023~1");
  const std::vector<RawPoint> points = recording();
  const CalibrationFit fit = fit_calibration(design(), points, kNoise);
  EXPECT_EQ(fit.report.points, points.size());
  EXPECT_NEAR(fit.report.rms_over_noise, 1, 0.05) << "of 4800 points: five of its sigmas";
}

TEST(Fit, ThatDoesNotConvergeIsRefused) {
  VERIFIES("LASSO-GND-023~1");
  const std::vector<RawPoint> points = recording();
  EXPECT_EQ(refusal_of(points, 2000), "none");
  EXPECT_NE(refusal_of(points, 20).find("does not converge in 20 evaluations: compare the planes"), std::string::npos);
}

TEST(Fit, ThatLeavesOutMoreThanATwentiethOfThePointsIsRefused) {
  VERIFIES("LASSO-GND-023~1");
  const std::vector<RawPoint> points = recording();
  const CalibrationFit few = fit_calibration(design(), with_strangers(points, 40), kNoise);
  EXPECT_LT(few.report.points, points.size());
  EXPECT_GE(few.report.points, points.size() * 95 / 100);

  // Two depths, and noise of a tenth and a fifth of them: about half of the points are before or behind every plane.
  PlaneRun noisy;
  noisy.depth_min_m = 2;
  noisy.depth_max_m = 4;
  noisy.angle_max_rad = 0.05;
  noisy.planes = 2;
  noisy.sigma_k_per_m = 0.05;
  const std::vector<RawPoint> scattered = simulate_planes(device(), noisy);
  const std::string refusal = refusal_of(scattered, 2000, noisy.sigma_k_per_m);
  EXPECT_NE(refusal.find(" of the " + std::to_string(scattered.size()) + " raw points: compare the planes"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace lasso::mdat
