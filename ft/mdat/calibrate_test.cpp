// mdat calibrate: a camera that is not as its design says is calibrated by a plane, and tracked by what was fitted.
#include <gtest/gtest.h>

#include <string>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// Focal length 2 %, baseline 1.5 % and angles 0.2 degrees off the design, growth with temperature, a residual polynomial.
constexpr char kDevice[] =
    "serial = 7\nfocal_length_m = 0.0817\nbaseline_m = 0.2031\nhalf_width_m = 0.08\nangle_x_offset_rad = 0.004\n"
    "angle_y_offset_rad = -0.003\nfocal_length_per_K = 3e-5\nbaseline_per_K = 2e-5\npeak_per_K = 2e-5\nreference_degC = 20\n"
    "angle_max_rad = 0.3\ndepth_min_m = 0.5\ndepth_max_m = 12\ntemperature_min_degC = -20\ntemperature_max_degC = 50\n"
    "residual = [0.001, -0.002, 0.001, 0.003, 0.002, -0.001, 0.0015, 0.001, -0.002, 0.0015]\n";
constexpr char kDesign[] =
    "serial = 7\nfocal_length_m = 0.08\nbaseline_m = 0.2\nhalf_width_m = 0.08\nangle_x_offset_rad = 0\n"
    "angle_y_offset_rad = 0\nfocal_length_per_K = 0\nbaseline_per_K = 0\npeak_per_K = 0\nreference_degC = 20\n"
    "angle_max_rad = 0.3\ndepth_min_m = 0.5\ndepth_max_m = 12\ntemperature_min_degC = -20\ntemperature_max_degC = 50\n"
    "residual = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0]\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

// The numbers that `mdat calibrate` prints behind a word.
double number_behind(const std::string& text, const std::string& word) {
  const std::size_t place = text.find(word);
  EXPECT_NE(place, std::string::npos) << text;
  return std::stod(text.substr(place + word.size()));
}

class Calibrate : public ::testing::Test {
 protected:
  Calibrate() {
    folder.write("device.toml", kDevice);
    folder.write("design.toml", kDesign);
  }
  Json track(const std::string& calibration, const std::string& seed) {
    const Answer answer = folder.mdat(
        "run missions/test.toml --scenario spin --frames 180 --no-report --out run --force --sensor lcs-wire --camera-optics device.toml "
        "--camera-temperature 35 --calibration " +
        calibration + " --seed " + seed);
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    return Json::parse(folder.read("run/results.json")).at("noisy");
  }
  const WorkFolder folder;
};

TEST_F(Calibrate, WhatIsFittedTracksAsThePerfectCalibrationDoes) {
  VERIFIES("LASSO-GND-023~1 LASSO-LCS-009~1");
  // A fit has learnt some noise: of two recordings enough to raise errors of position by 1 to 7 % (means of 1500 frames, four pairs of
  // recordings). In their squares that is the inverse of the number of points, so that six recordings leave 1.6 %.
  std::string recordings;
  for (const std::string seed : {"5", "6", "7", "8", "9", "10"}) {
    recordings += " raw" + seed + ".csv";
    ASSERT_EQ(folder.mdat("calibrate --simulate device.toml --seed " + seed + " -o raw" + seed + ".csv").exit_code, 0);
  }
  const Answer answer = folder.mdat("calibrate" + recordings + " --start design.toml -o fitted.toml --picture residuals.png");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::string after = answer.out.substr(answer.out.find("after:"));
  EXPECT_GT(number_behind(after, "after:"), 84000) << "all points lie in the calibrated volume";
  EXPECT_LE(number_behind(after, "mm, "), 1.1) << "rms over noise: " << after;
  EXPECT_GT(number_behind(after, "mm, "), 0.97) << "no less than the noise is there";
  EXPECT_LE(number_behind(after, "worst cell "), 1.1) << "of 64 cells of some 1350 points each: five of their sigmas above 1";
  EXPECT_GT(number_behind(answer.out, "mm, "), 50) << "before: the design is far off";
  EXPECT_EQ(folder.read("residuals.png").substr(1, 3), "PNG");

  // New points of the same device, by the fitted table: it has not learnt the noise.
  ASSERT_EQ(folder.mdat("calibrate --simulate device.toml --seed 77 -o other.csv").exit_code, 0);
  const Answer other = folder.mdat("calibrate other.csv --start fitted.toml -o again.toml");
  EXPECT_LE(number_behind(other.out.substr(other.out.find("before:")), "mm, "), 1.1) << other.out;

  // Both cameras draw the same noise: over 540 frames the ratio scatters by 0.7 % (translation) and 0.4 % (rotation), a fifth of the
  // margin.
  double perfect_mm = 0, fitted_mm = 0, perfect_deg = 0, fitted_deg = 0;
  for (const std::string seed : {"1", "2", "3"}) {
    const Json perfect = track("device.toml", seed), fitted = track("fitted.toml", seed);
    for (const Json* run : {&perfect, &fitted}) {
      EXPECT_EQ(run->at("wrong"), 0);
      EXPECT_EQ(run->at("lost"), 0);
    }
    perfect_mm += perfect.at("rms_mm").get<double>();
    fitted_mm += fitted.at("rms_mm").get<double>();
    perfect_deg += perfect.at("rms_deg").get<double>();
    fitted_deg += fitted.at("rms_deg").get<double>();
  }
  EXPECT_LE(fitted_mm, 1.05 * perfect_mm);
  EXPECT_LE(fitted_deg, 1.05 * perfect_deg);
}

// The mission names its calibration, and its image brings it to the driver: the same flight as with --calibration, and not the design's.
TEST_F(Calibrate, TheMissionsImageCarriesIt) {
  VERIFIES("LASSO-LCS-007~2");
  folder.write_mission({{"[sensor] ", "[sensor]\ncalibration = 'other.toml' "}});
  folder.write("other.toml", replaced(replaced(kDevice, "0.0817", "0.0818"), "0.004", "0.0045"));
  const std::string run =
      "run missions/test.toml --scenario spin --frames 40 --no-report --out run --force --sensor lcs-wire --camera-optics device.toml";
  const auto poses = [&](const std::string& more) {
    const Answer answer = folder.mdat(run + more);
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    return folder.mdat("decode run/telemetry.ccsds --packet pose --items p_sensor_target_m --format csv").out;
  };
  const std::string named = poses("");
  EXPECT_TRUE(named != poses(" --calibration device.toml"));
  EXPECT_EQ(Json::parse(folder.read("run/results.json")).at("noisy").at("lost"), 0);
  folder.write("other.toml", kDevice);
  const std::string right = poses("");
  EXPECT_TRUE(named != right);
  EXPECT_TRUE(right == poses(" --calibration device.toml"));
  EXPECT_GT(lines_of(right).size(), 30U);
}

// Uncalibrated it is far off, and says so: what would be wrong poses are not valid.
TEST_F(Calibrate, TheDesignsTableGivesNoWrongPoseThatIsValid) {
  VERIFIES("LASSO-LCS-009~1");
  const Json run = track("design.toml", "1");
  EXPECT_EQ(run.at("wrong"), 0);
  EXPECT_EQ(run.at("invalid"), 180);
  EXPECT_EQ(run.at("lost"), 180);
}

TEST_F(Calibrate, ATableOfAnotherDeviceGivesNoScan) {
  VERIFIES("LASSO-LCS-015~2");
  folder.write("foreign.toml", replaced(kDevice, "serial = 7", "serial = 8"));
  EXPECT_EQ(track("foreign.toml", "1").at("lost"), 180);
  const Answer decoded = folder.mdat("decode run/telemetry.ccsds --packet sensor --items last_loss,lost_foreign --format csv");
  const std::vector<std::string> last = fields_of(lines_of(decoded.out).back());
  EXPECT_EQ(last.at(3), "foreign");
  EXPECT_GT(std::stol(last.at(4)), 100);
}

TEST_F(Calibrate, BadTablesAndRecordingsAreRefusedWithTheirPlace) {
  VERIFIES("LASSO-LCS-015~2 LASSO-GND-023~1");
  const std::string header = "plane_nx,plane_ny,plane_nz,plane_d_m,temperature_degC,angle_x_rad,angle_y_rad,peak\n";
  folder.write("raw.csv", header + "0,0,1,3,20,0,0,0.06\n");
  folder.write("header.csv", "x,y\n1,2\n");
  folder.write("row.csv", header + "0,0,1,3,20,0,0,0.06\n0,0,1,3,20,0,0\n");
  folder.write("word.csv", header + "0,0,1,three,20,0,0,0.06\n");
  folder.write("long.csv", header + "0,0,2,3,20,0,0,0.06\n");
  folder.write("singular.toml", replaced(kDevice, "baseline_m = 0.2031", "baseline_m = 0.0"));
  folder.write("empty.toml", replaced(kDevice, "depth_min_m = 0.5", "depth_min_m = 13"));
  folder.write("short.toml", replaced(kDevice, "0.001, -0.002, 0.001, 0.003", "0.001"));
  folder.write("missing.toml", replaced(kDevice, "serial = 7\n", ""));
  folder.write("unknown.toml", std::string(kDevice) + "colour = 3\n");
  const std::pair<const char*, const char*> cases[] = {
      {"calibrate raw.csv --start design.toml -o out.toml", "at least 1000 raw points"},
      {"calibrate none.csv --start design.toml -o out.toml", "none.csv"},
      {"calibrate header.csv --start design.toml -o out.toml", "header.csv:1:1: the header is"},
      {"calibrate row.csv --start design.toml -o out.toml", "row.csv:3: the row has"},
      {"calibrate word.csv --start design.toml -o out.toml", "word.csv:2:"},
      {"calibrate long.csv --start design.toml -o out.toml", "long.csv:2: the plane's normal is not of unit length"},
      {"calibrate raw.csv --start singular.toml -o out.toml", "singular.toml: singular"},
      {"calibrate raw.csv --start empty.toml -o out.toml", "empty.toml: bad value"},
      {"calibrate raw.csv --start short.toml -o out.toml", "short.toml:16"},
      {"calibrate raw.csv --start missing.toml -o out.toml", "serial"},
      {"calibrate raw.csv --start unknown.toml -o out.toml", "unknown.toml:17"},
      {"calibrate raw.csv -o out.toml", "--start"},
      {"calibrate --start design.toml -o out.toml", "RECORDING"},
      {"run missions/test.toml --calibration device.toml", "--sensor lcs-wire"},
      {"run missions/test.toml --sensor lcs-wire --calibration singular.toml", "singular.toml: singular"},
  };
  for (const auto& [command, why] : cases) {
    const Answer answer = folder.mdat(command);
    EXPECT_EQ(answer.exit_code, 2) << command;
    EXPECT_NE(answer.err.find(why), std::string::npos) << command << answer.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.toml"));
}

}  // namespace
}  // namespace lasso::ft
