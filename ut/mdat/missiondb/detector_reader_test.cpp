#include "mdat/missiondb/detector_reader.hpp"

#include "mdat/missiondb/mission_text.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kDetectorHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";  // 6 lines

class DetectorReaderTest : public ::testing::Test {
 protected:
  DetectorReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kDetectorHead + text)); }
  void expect_refusal(const std::string& text, const std::string& expected) {
    const std::string said = mission_error_of([&] { static_cast<void>(load(text)); });
    EXPECT_NE(said.find(expected), std::string::npos) << "got: " << said << "\nexpected: " << expected;
  }
  Folder folder_;
};

TEST_F(DetectorReaderTest, ReadsTheDetectorOfEachSensorInItsUnits) {
  VERIFIES("LASSO-SIM-062~1 LASSO-SIM-065~1");
  const MissionSource source = load(
      "[sensor.detector]\nreference_electrons = 3000\nbandpass_nm = 10\nenergy_uJ = 2\nfield_mrad = 0.5\ngate_us = 0.01\n"
      "[further_sensor.far.detector]\nreturns = 'last'\n[scenario.one]\nvariants = true\nranges_m = [3]\n");
  EXPECT_EQ(source.detector.reference_electrons, 3000);
  EXPECT_NEAR(source.detector.bandpass_m, 10e-9, 1e-20);
  EXPECT_NEAR(source.detector.energy_J, 2e-6, 1e-18);
  EXPECT_NEAR(source.detector.field_rad, 5e-4, 1e-15);
  EXPECT_NEAR(source.detector.gate_s, 1e-8, 1e-20);
  EXPECT_EQ(source.scenarios.at("one").detector.reference_electrons, 3000);
  EXPECT_EQ(source.further_sensors.at(0).detector.returns, sim::Returns::kLast);
  EXPECT_FALSE(sim::is_simulated(source.further_sensors.at(0).detector));
  ASSERT_FALSE(source.warnings.empty());
  bool warned = false;
  for (const std::string& warning : source.warnings)
    warned = warned ||
             warning.find("m.toml:9:15: sensor.detector.bandpass_nm: 10: changes nothing: the mission has no [orbit]") != std::string::npos;
  EXPECT_TRUE(warned) << source.warnings[0];
  bool told = false;
  for (const EffectiveValue& value : effective_values(source, "one"))
    told = told || (value.key == "sensor.detector.energy_uJ" && value.value == "2");
  EXPECT_TRUE(told);
}

TEST_F(DetectorReaderTest, ValuesThatContradictEachOtherAreToldWithTheirPlace) {
  VERIFIES("LASSO-SIM-062~1");
  expect_refusal("[sensor.detector]\nwidth_m = 1\n", "m.toml:8:11: sensor.detector.width_m: 1: has no effect without");
  expect_refusal("[sensor.detector]\nreference_electrons = 3000\nbandpass_nm = 10\n",
                 "m.toml:9:15: sensor.detector.bandpass_nm: 10: sunlight is in");
  expect_refusal("[sensor.detector]\nreference_electrons = 3000\nthreshold_electrons = 10\nsaturation_electrons = 10\n",
                 "sensor.detector.saturation_electrons: 10: nothing between");
  expect_refusal("[sensor.detector]\nreference_electrons = 3000\nnoise_electrons = 10\n",
                 "sensor.detector.threshold_electrons: 0: noise alone would be told as returns: expected at least 3 times");
  expect_refusal("[sensor.detector]\nreturns = 'middle'\n", "sensor.detector.returns: 'middle': expected one of \"mixed\"");
  expect_refusal("[further_sensor.far.detector]\nnoise_electrons = -1\n", "further_sensor.far.detector.noise_electrons");
}

}  // namespace
}  // namespace lasso::mdat
