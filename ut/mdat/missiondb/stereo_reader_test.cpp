#include "mdat/missiondb/stereo_reader.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kStereoHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'one.toml'\n";  // 6 lines

class StereoReaderTest : public ::testing::Test {
 protected:
  StereoReaderTest() { folder_.write("one.toml", "[[part]]\nname = 'bus'\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kStereoHead + text)); }
  Folder folder_;
};

TEST_F(StereoReaderTest, ReadsTheHeadAndItsLight) {
  VERIFIES("LASSO-STE-008~1");
  const StereoSource stereo =
      load(
          "[stereo]\nbaseline_m = 0.5\npixels = 640\npixel_um = 3.5\nlamp_Wpsr = 26\nsun = [0, 0, 0]\nplain = true\n"
          "turn_error_deg = [0, 0.1, 0]\nbaseline_error = -0.01\n")
          .stereo;
  EXPECT_EQ(stereo.baseline_m, 0.5);
  EXPECT_EQ(stereo.pixels, 640);
  EXPECT_NEAR(stereo.pixel_m, 3.5e-6, 1e-15);
  EXPECT_EQ(stereo.lamp_Wpsr, 26);
  EXPECT_EQ(stereo.sun, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(stereo.plain, 1);
  EXPECT_NEAR(stereo.turn_error_rad[1], 0.1 * kRadPerDeg, 1e-15);
  EXPECT_EQ(stereo.baseline_error, -0.01);
  EXPECT_EQ(stereo.f_number, 8) << "a preset";
}

TEST_F(StereoReaderTest, PairsAreRenderedUnlessItSaysFitted) {
  VERIFIES("LASSO-STE-016~1");
  EXPECT_FALSE(load("").stereo.is_fitted());
  EXPECT_FALSE(load("[stereo]\nmodel = 'rendered'\n").stereo.is_fitted());
  EXPECT_TRUE(load("[stereo]\nmodel = 'fitted'\n").stereo.is_fitted());
  const std::string problem = mission_error_of([&] { static_cast<void>(load("[stereo]\nmodel = 'fit'\n")); });
  EXPECT_NE(problem.find("m.toml:8:9: stereo.model"), std::string::npos) << problem;
  EXPECT_NE(problem.find("fitted"), std::string::npos) << problem;
}

TEST_F(StereoReaderTest, PresetsAreThoseOfAMissionWithoutStereo) {
  VERIFIES("LASSO-STE-008~1");
  const StereoSource none = load("").stereo, empty = load("[stereo]\n").stereo;
  for (double StereoSource::*member :
       {&StereoSource::baseline_m, &StereoSource::pixels, &StereoSource::f_number, &StereoSource::full_well_e, &StereoSource::read_noise_e,
        &StereoSource::exposure_s, &StereoSource::samples, &StereoSource::lamp_Wpsr, &StereoSource::earthshine,
        &StereoSource::baseline_error})
    EXPECT_EQ(none.*member, empty.*member);
  EXPECT_NEAR(none.pixel_m, empty.pixel_m, 1e-18);
  EXPECT_EQ(none.sun, empty.sun);
  EXPECT_EQ(none.earth, empty.earth);
}

TEST_F(StereoReaderTest, ProblemsAreToldWithTheirPlace) {
  VERIFIES("LASSO-STE-008~1");
  const auto problem = [&](const std::string& text) { return mission_error_of([&] { static_cast<void>(load(text)); }); };
  EXPECT_NE(problem("[stereo]\nbaseline_m = -1\n").find("m.toml:8:14: stereo.baseline_m: -1"), std::string::npos)
      << problem("[stereo]\nbaseline_m = -1\n");
  EXPECT_NE(problem("[stereo]\nbaselines_m = 1\n").find("stereo.baselines_m"), std::string::npos);
  EXPECT_NE(problem("stereo = 1\n").find("stereo"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
