#include "mdat/stereo/fitted_stereo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ut/mdat/stereo/squares.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Errors evenly within 0.4 px, three of five pixels found where it is not dark.
StereoFit even_fit() {
  StereoFit fit;
  for (RegionFit& region : fit) {
    region.valid.fill(0.6);
    region.valid[0] = 0;
    for (auto& errors_px : region.errors_px) {
      for (std::size_t q = 0; q < kFitQuantiles; ++q) errors_px[q] = 0.8 * kFitShares[q] - 0.4;
    }
  }
  return fit;
}

class FittedStereoTest : public ::testing::Test {
 protected:
  FittedStereoTest() : head_(small_head()), fit_(even_fit()), surface_(surface_of(two_squares(3, 1.6, 8, 0.1))) {}

  // Disparity errors of every second pixel of the square's middle; NaN where nothing was found. `turn_rad`: of the target about the axis.
  std::vector<double> errors_of(FittedStereo& stereo, double turn_rad, const Lights& lights = sun_behind()) {
    const StereoView view{surface_, {matt(0.5)}, lights, {exp_so3(Vec3(0, 0, turn_rad)), Vec3::Zero()}};
    stereo.take(view, {2, 10});
    std::vector<double> errors;
    for (int row = 70; row < 130; row += 2) {
      for (int column = 70; column < 130; column += 2) {
        const RangeSample sample = stereo.sample(head_.camera.direction(column, row), 5);
        EXPECT_NE(sample.state, RayState::kMiss);
        EXPECT_EQ(sample.t_us, 5);
        const double depth_m = static_cast<double>(sample.range_m) * static_cast<double>(sample.direction[2]);
        errors.push_back(sample.state == RayState::kHit ? head_.camera.focal_px * 0.2 * (1 / depth_m - 1.0 / 3) : std::nan(""));
      }
    }
    return errors;
  }

  StereoHead head_;
  StereoFit fit_;
  ModelSurface surface_;
};

double found_share(const std::vector<double>& errors) {
  double found = 0;
  for (const double error : errors) found += std::isnan(error) ? 0 : 1;
  return found / static_cast<double>(errors.size());
}

// Mean of products over pairs of pixels that both have a value, over the mean square.
double likeness(const std::vector<double>& a, const std::vector<double>& b, std::size_t shift = 0) {
  double products = 0, squares = 0;
  for (std::size_t i = 0; i + shift < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i + shift])) continue;
    products += a[i] * b[i + shift];
    squares += 0.5 * (a[i] * a[i] + b[i + shift] * b[i + shift]);
  }
  return products / squares;
}

TEST_F(FittedStereoTest, HasTheErrorsThatItWasFittedTo) {
  VERIFIES("LASSO-STE-015~1");
  double found = 0, squares = 0, count = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    FittedStereo stereo(head_, seed, fit_);
    const std::vector<double> errors = errors_of(stereo, 0);
    found += found_share(errors) / 6;
    for (const double error : errors) {
      if (std::isnan(error)) continue;
      squares += error * error;
      ++count;
      EXPECT_LE(std::fabs(error), 0.4 + 0.5 / kDisparitySteps + 1e-4);
    }
  }
  EXPECT_NEAR(found, 0.6, 0.08);
  EXPECT_NEAR(std::sqrt(squares / count), 0.8 / std::sqrt(12.0), 0.06) << "of an even distribution";
}

TEST_F(FittedStereoTest, NeighboursAndFramesOfOneViewHaveErrorsInCommon) {
  VERIFIES("LASSO-STE-015~1");
  double near = 0, far = 0, next = 0, turned = 0;
  constexpr int kSeeds = 6;
  FittedCommon common;
  common.view_share = 0;
  common.part_share = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    FittedStereo stereo(head_, seed, fit_, common);
    const std::vector<double> first = errors_of(stereo, 0), second = errors_of(stereo, 0), third = errors_of(stereo, 0.18);
    near += likeness(first, first, 1) / kSeeds;
    far += likeness(first, first, 15) / kSeeds;
    next += likeness(first, second) / kSeeds;
    turned += likeness(first, third) / kSeeds;
  }
  EXPECT_NEAR(near, std::exp(-4 / (4 * common.near_px * common.near_px)), 0.08);
  EXPECT_NEAR(far, 0, 0.15);
  EXPECT_NEAR(next, common.kept_share, 0.12);
  EXPECT_NEAR(turned, 0, 0.15) << "two views on";
}

TEST_F(FittedStereoTest, SaysNothingWhereItIsDarkOrEmptyOrNotWithinItsDepths) {
  VERIFIES("LASSO-STE-015~1");
  FittedStereo stereo(head_, 3, fit_);
  EXPECT_EQ(found_share(errors_of(stereo, 0, Lights{})), 0) << "no light";
  const StereoView view{surface_, {matt(0.5)}, sun_behind(), Pose{}};
  stereo.take(view, {4, 10});
  for (int column = 80; column < 120; ++column)
    EXPECT_EQ(stereo.sample(head_.camera.direction(column, 100), 0).state, RayState::kInvalid) << "the square is at 3 m";
  stereo.take(view, {2, 10});
  for (const Vec3& direction : {Vec3(0.4, 0.4, 1), Vec3(3, 0, 1), Vec3(0, 0, -1)})
    EXPECT_EQ(stereo.sample(direction.normalized(), 0).state, RayState::kInvalid);
}

TEST_F(FittedStereoTest, ItsExposureFollowsTheLightAFrameLater) {
  VERIFIES("LASSO-STE-015~1");
  head_.source.exposure_s = 0;
  FittedStereo stereo(head_, 3, fit_);
  Lights dim = sun_behind();
  dim.sun_share = 0.1;
  errors_of(stereo, 0);
  const double bright_s = stereo.exposure_s();
  errors_of(stereo, 0, dim);
  EXPECT_NEAR(stereo.exposure_s(), bright_s, 0.02 * bright_s);
  errors_of(stereo, 0, dim);
  EXPECT_NEAR(stereo.exposure_s(), 10 * bright_s, bright_s);
}

}  // namespace
}  // namespace lasso::mdat
