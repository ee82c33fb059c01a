#include "mdat/stereo/pair_sight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/stereo/exposure_control.hpp"
#include "ut/mdat/stereo/squares.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class PairSightTest : public ::testing::Test {
 protected:
  PairSightTest() : head_(small_head()), surface_(surface_of(two_squares(2, 0.4, 4, 2))) {}
  StereoView view(const Lights& lights) const { return {surface_, {matt(0.5)}, lights, Pose{}}; }
  // Of a place in the plane at a depth.
  int column_of(double x_m, double depth_m) const {
    return static_cast<int>(std::lround(head_.camera.center_x + head_.camera.focal_px * x_m / depth_m));
  }
  int middle_row() const { return static_cast<int>(head_.camera.center_y); }

  StereoHead head_;
  ModelSurface surface_;
};

// Shadow and disparity by similar triangles: f b / z; the right camera sees nothing of a strip of f b (1/2 - 1/4) pixels on the left.
TEST_F(PairSightTest, TellsWhatBothCamerasSee) {
  VERIFIES("LASSO-STE-015~1");
  const StereoView seen = view(sun_behind());
  const PairSight sight(head_, seen);
  const double near_px = head_.camera.focal_px * 0.2 / 2, far_px = head_.camera.focal_px * 0.2 / 4;
  const int row = middle_row(), left = column_of(-0.2, 2), right = column_of(0.2, 2), rim = column_of(1, 4);
  const auto at = [&](int column) { return sight.at(column, row, 1e-4); };
  EXPECT_EQ(at((left + right) / 2).region, PixelRegion::kInside);
  EXPECT_NEAR(at((left + right) / 2).disparity_px, near_px, 1e-6);
  EXPECT_EQ(at(right - 2).region, PixelRegion::kNearEdge);
  EXPECT_EQ(at(right + 3).region, PixelRegion::kFarEdge);
  EXPECT_NEAR(at(right + 3).disparity_px, far_px, 1e-6);
  EXPECT_NEAR(at(right + 3).nearer_px, near_px, 1e-6);
  EXPECT_EQ(at(right + 8).region, PixelRegion::kInside);
  EXPECT_EQ(at(left - static_cast<int>(near_px - far_px) + 2).region, PixelRegion::kHidden);
  EXPECT_EQ(at(left - static_cast<int>(near_px - far_px) - 7).region, PixelRegion::kInside);
  EXPECT_EQ(at(rim + 3).region, PixelRegion::kSky);
  EXPECT_NEAR(at(rim + 3).nearer_px, far_px, 1e-6);
  EXPECT_EQ(at(rim + 9).region, PixelRegion::kEmpty);
}

TEST_F(PairSightTest, AWrongCalibrationIsInItsDisparities) {
  VERIFIES("LASSO-STE-015~1");
  head_.T_left_right.p.x() = 0.21;
  const StereoView seen = view(sun_behind());
  EXPECT_NEAR(PairSight(head_, seen).at(column_of(0, 2), middle_row(), 1e-4).disparity_px, head_.camera.focal_px * 0.21 / 2, 1e-6);
}

// A matt surface that faces sun and camera has the radiance E rho / pi.
TEST_F(PairSightTest, TellsHowBrightAPixelIs) {
  VERIFIES("LASSO-STE-015~1");
  const StereoView seen = view(sun_behind()), dark = view(Lights{});
  const PairSight sight(head_, seen);
  const double electrons = kBandShare * kSun_Wpm2 * 0.5 / kPi * electrons_per_radiance(head_.imager) * 1e-4;
  EXPECT_NEAR(sight.at(column_of(0, 2), middle_row(), 1e-4).level, std::sqrt(electrons / head_.imager.full_well_e), 0.01);
  EXPECT_EQ(sight.at(column_of(0, 2), middle_row(), 10).level, 1) << "the well is full";
  EXPECT_EQ(PairSight(head_, dark).at(column_of(0, 2), middle_row(), 1e-4).level, 0);
  EXPECT_NEAR(kSun_Wpm2 * kBandShare * 0.5 / kPi * electrons_per_radiance(head_.imager) * sight.settled_exposure_s(),
              kMeteredLevel * head_.imager.full_well_e, 0.02 * head_.imager.full_well_e);
  EXPECT_EQ(PairSight(head_, dark).settled_exposure_s(), kLongest_s);
  EXPECT_NEAR(sight.next_exposure_s(1e-5 + 1e-5), sight.settled_exposure_s(), 0.05 * sight.settled_exposure_s());
}

// The matcher's mask: a pixel is dark, too, where a window beside it is.
TEST_F(PairSightTest, TellsWhatIsTooDarkToBeMatched) {
  VERIFIES("LASSO-STE-015~1");
  const StereoView seen = view(sun_behind()), dark = view(Lights{});
  const PairSight sight(head_, seen);
  const int rim = column_of(1, 4), row = middle_row();
  EXPECT_FALSE(sight.at(column_of(0, 2), row, 1e-4).dark);
  EXPECT_FALSE(sight.at(rim - 4, row, 1e-4).dark);
  EXPECT_TRUE(sight.at(rim - 1, row, 1e-4).dark) << "beside the sky";
  EXPECT_TRUE(sight.at(rim + 3, row, 1e-4).dark) << "the sky";
  EXPECT_TRUE(sight.at(column_of(0, 2), row, 1e-9).dark) << "hardly exposed";
  EXPECT_TRUE(PairSight(head_, dark).at(column_of(0, 2), row, 1e-4).dark);
}

}  // namespace
}  // namespace lasso::mdat
