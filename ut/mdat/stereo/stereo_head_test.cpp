#include "mdat/stereo/stereo_head.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/mdat/render/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kHalf_rad = 0.25;

StereoSource small_source() {
  StereoSource source;
  source.pixels = 120;
  source.baseline_m = 0.2;
  source.samples = 4;
  source.read_noise_e = 1;
  return source;
}

// Middle of what is lit in a picture, weighted by its light.
Eigen::Vector2d middle_of_light(const GreyPicture<std::uint8_t>& picture) {
  double sum = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const double code = picture.codes[static_cast<std::size_t>(row * picture.width + column)];
      if (code < 60) continue;
      sum += code * code;
      first += code * code * Eigen::Vector2d(column, row);
    }
  }
  return first / sum;
}

// A white square across the boresight at 4 m, the sun behind the cameras.
StereoPictures pictures_of_square(const StereoSource& source, std::uint64_t seed = 3, unsigned jobs = 1) {
  static const ModelSurface surface = surface_of(square(0.5));
  const Pose pose{Quat::Identity(), Vec3(0.1, -0.2, 4)};
  Lights lights;
  lights.sun = -Vec3::UnitZ();
  StereoCamera camera(make_head(source, kHalf_rad, kHalf_rad), seed);
  return camera.take({surface, {matt(0.5)}, lights, pose}, jobs);
}

TEST(StereoHead, BothCamerasSeeThePointsWhereTheirPlacesHaveThem) {
  VERIFIES("LASSO-STE-009~1");
  const StereoSource source = small_source();
  const StereoHead head = make_head(source, kHalf_rad, kHalf_rad);
  EXPECT_NEAR(head.camera.focal_px, 60 / std::tan(kHalf_rad), 1e-9);
  const StereoPictures pictures = pictures_of_square(source);
  const Eigen::Vector2d left = head.camera.pixel(Vec3(0.1, -0.2, 4)), right = head.camera.pixel(Vec3(0.1 - 0.2, -0.2, 4));
  EXPECT_LT((middle_of_light(pictures.left) - left).norm(), 0.15);
  EXPECT_LT((middle_of_light(pictures.right) - right).norm(), 0.15);
}

// The calibration says nothing of it.
TEST(StereoHead, AWrongCalibrationShiftsTheRightPictureByTheTurn) {
  VERIFIES("LASSO-STE-009~1");
  StereoSource turned = small_source();
  turned.turn_error_rad = {0, 0.02, 0};
  turned.baseline_error = 0.1;
  const StereoHead head = make_head(turned, kHalf_rad, kHalf_rad);
  EXPECT_EQ(head.stated.T_left_right.p, Vec3(0.2, 0, 0));
  EXPECT_EQ(head.stated.T_left_right.q.w(), 1);
  EXPECT_NEAR(head.T_left_right.p.x(), 0.22, 1e-12);
  const double shift_px =
      middle_of_light(pictures_of_square(turned).right).x() - middle_of_light(pictures_of_square(small_source()).right).x();
  const double expected_px = -head.camera.focal_px * (0.02 + 0.02 / 4);  // turn to the right, and 20 mm more of baseline at 4 m
  EXPECT_NEAR(shift_px, expected_px, 0.15);
}

TEST(StereoHead, PicturesDependOnTheSeedAndNotOnThreads) {
  VERIFIES("LASSO-STE-002~1");
  const StereoPictures one = pictures_of_square(small_source(), 3, 1), same = pictures_of_square(small_source(), 3, 3);
  EXPECT_EQ(one.left.codes, same.left.codes);
  EXPECT_EQ(one.right.codes, same.right.codes);
  EXPECT_NE(one.left.codes, pictures_of_square(small_source(), 4).left.codes);
}

// A matt plate of reflectance 0.5 in the full sun: L = 0.59 * 1361 * 0.5 / pi. An exposure that is given holds.
TEST(StereoHead, ExposureIsAsGivenAndMakesTheElectronsOfTheRadiance) {
  VERIFIES("LASSO-STE-001~1");
  StereoSource source = small_source();
  source.exposure_s = 1e-4;
  const StereoPictures pictures = pictures_of_square(source);
  EXPECT_EQ(pictures.exposure_s, 1e-4);
  const double electrons = 0.59 * 1361 * 0.5 / 3.14159265 * electrons_per_radiance(Imager{}) * 1e-4 * (1 - Imager{}.glare);
  const StereoHead head = make_head(source, kHalf_rad, kHalf_rad);
  const Eigen::Vector2d at = head.camera.pixel(Vec3(0.1, -0.2, 4));
  const double code = pictures.left.codes[static_cast<std::size_t>(std::lround(at.y()) * 120 + std::lround(at.x()))];
  EXPECT_NEAR(code, 255 * std::sqrt(electrons / 20000), 4);
}

TEST(StereoHead, NextExposureFollowsTheFrameBefore) {
  VERIFIES("LASSO-STE-003~1");
  const ModelSurface surface = surface_of(square(0.5));
  StereoCamera camera(make_head(small_source(), kHalf_rad, kHalf_rad), 3);
  Lights bright, dim;
  bright.sun = -Vec3::UnitZ();
  dim = bright;
  dim.sun_share = 0.25;
  const Pose pose{Quat::Identity(), Vec3(0, 0, 4)};
  const double first_s = camera.take({surface, {matt(0.5)}, bright, pose}, 1).exposure_s;
  const double late_s = camera.take({surface, {matt(0.5)}, dim, pose}, 1).exposure_s;
  const double settled_s = camera.take({surface, {matt(0.5)}, dim, pose}, 1).exposure_s;
  EXPECT_NEAR(late_s / first_s, 1, 0.02) << "the light has changed, and nobody has seen it yet";
  EXPECT_NEAR(settled_s / first_s, 4, 0.2);
}

TEST(StereoHead, LightIsThatOfTheOrbitUnlessItHasNone) {
  VERIFIES("LASSO-STE-009~1");
  StereoSource source;
  source.sun = {0, 0, -2};
  source.earthshine = 0;
  source.lamp_Wpsr = 26;
  const Lights lights = stereo_lights(source, std::nullopt, {});
  EXPECT_EQ(lights.sun, Vec3(0, 0, -1));
  EXPECT_FALSE(lights.earth.has_value());
  ASSERT_EQ(lights.lamps.size(), 1U);
  EXPECT_EQ(lights.lamps[0].place_m, Vec3(0, 0, 0));
  EXPECT_NEAR(lights.lamps[0].intensity_Wpsr * kBandShare, 26, 1e-12);
  Lamp other;
  other.place_m = Vec3(1, 0, 0);
  EXPECT_EQ(stereo_lights(source, std::nullopt, {other}).lamps.size(), 2U);
  Lights orbit;
  orbit.sun = Vec3::UnitX();
  orbit.sun_share = 0.3;
  EXPECT_EQ(stereo_lights(source, orbit, {}).sun, Vec3(1, 0, 0));
  EXPECT_EQ(stereo_lights(source, orbit, {}).sun_share, 0.3);
}

TEST(StereoHead, PlainMaterialsHaveNoReliefAndNoShades) {
  VERIFIES("LASSO-STE-009~1");
  StereoSource plain;
  plain.plain = 1;
  const std::vector<Material> presets(material_presets().begin(), material_presets().end());
  for (const Material& material : stereo_materials(plain, presets))
    EXPECT_EQ(material.tilt_rad + material.contrast + material.grid_pitch, 0);
  EXPECT_GT(stereo_materials(StereoSource{}, presets)[1].tilt_rad, 0);
}

}  // namespace
}  // namespace lasso::mdat
