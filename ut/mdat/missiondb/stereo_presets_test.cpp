#include "mdat/missiondb/stereo_presets.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kStereoSensor =
    "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n[sensor]\nkind = 'stereo'\n";

class StereoPresetsTest : public ::testing::Test {
 protected:
  StereoPresetsTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kStereoSensor + text)); }
  std::string warnings(const std::string& text) {
    std::string all;
    for (const std::string& warning : warnings_for(load(text), "")) all += warning + "\n";
    return all;
  }
  Folder folder_;
};

// 512 pixels on either side of the axis within 20 deg: f = 1407 pixels, and 0.5 of them at a baseline of 0.3 m.
TEST_F(StereoPresetsTest, AreThoseOfTheHeadThatIsThePreset) {
  VERIFIES("LASSO-STE-012~1");
  const MissionSource source = load("");
  EXPECT_EQ(source.sensor, SensorKind::kStereo);
  const MissionParameters& p = source.parameters;
  EXPECT_NEAR(p.fov_half_x_rad, 20 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(p.sigma_k_per_m, 0.5 / (512 / std::tan(20 * kRadPerDeg) * 0.3), 1e-7);
  EXPECT_NEAR(stereo_noise_per_m(source.stereo, p.fov_half_x_rad), p.sigma_k_per_m, 1e-7);
  EXPECT_EQ(p.silhouettes, 0);
  EXPECT_EQ(p.deskew, 0);
  EXPECT_EQ(p.kernel_width, 4);
  EXPECT_EQ(p.noise_estimated, 0);
  EXPECT_GT(p.common_sigma_k_per_m, 0);
}

TEST_F(StereoPresetsTest, WhatIsWrittenHolds) {
  VERIFIES("LASSO-STE-012~1");
  const MissionParameters p = load("sigma_k_per_m = 1e-3\n[estimation]\nkernel_width = 6\nsilhouettes = true\n").parameters;
  EXPECT_EQ(p.sigma_k_per_m, 1e-3);
  EXPECT_EQ(p.kernel_width, 6);
  EXPECT_EQ(p.silhouettes, 1);
}

TEST_F(StereoPresetsTest, AnotherHeadWithTheSameNoiseIsDoubtful) {
  VERIFIES("LASSO-STE-012~1");
  EXPECT_EQ(warnings("").find("pixels of disparity"), std::string::npos) << warnings("");
  EXPECT_NE(warnings("[stereo]\nbaseline_m = 0.1\n").find("0.1 m apart, make 0.5 pixels of disparity 0.00355"), std::string::npos)
      << warnings("[stereo]\nbaseline_m = 0.1\n");
}

}  // namespace
}  // namespace lasso::mdat
