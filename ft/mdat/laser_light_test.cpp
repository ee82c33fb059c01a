// Simulated lasers that see materials, sunlight and clouds, from the mission file to telemetry.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::string kDetector = R"(
[sensor.detector]
reference_electrons = 20000
reference_range_m = 4
reference_reflectance = 0.5
noise_electrons = 30
threshold_electrons = 200
width_k_per_m = 5e-4
)";

const std::string kLitScene = R"(
[orbit]
altitude_km = 400
angle_deg = ANGLE

[motion.spin]
kind = "rates"
position_m = [0.02, -0.01, 4.0]
quaternion = [-0.088182217301, -0.096234003384, -0.669810439735, 0.730969826988]
spin_degps = [5, 0, 0]

[motion.before]             # a cloud that stands between sensor and target from 2 s on
kind = "waypoints"
at = [{time_s = 1.5, position_m = [3, 0, 2]}, {time_s = 2, position_m = [0, 0, 2]}]

[node.telescope]
target = true
motion = "spin"

CLOUD
[node.camera]
sensor = true

[scenario.lit]
frames = 20

[scenario.checked]
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

// Telemetry of a run of the scene; `angle_deg`: where in the orbit it is.
std::string telemetry_of(const WorkFolder& work, const std::string& detector, const std::string& angle_deg, const std::string& cloud,
                         const std::string& out) {
  const std::string scene = replaced(replaced(kLitScene, "ANGLE", angle_deg), "CLOUD", cloud);
  work.write_mission({{"\n[scenario.checked]\n", detector + scene}});
  const Answer answer = work.mdat("run missions/test.toml --scenario lit --no-report --out out/" + out);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  return work.read("out/" + out + "/telemetry.ccsds");
}

std::vector<std::string> valid_column(const WorkFolder& work, const std::string& out) {
  const std::vector<std::string> lines = lines_of(work.read("out/" + out + "/frames.csv"));
  const std::vector<std::string> names = fields_of(lines.at(0));
  const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), "valid") - names.begin());
  std::vector<std::string> result;
  for (std::size_t i = 1; i < lines.size(); ++i) result.push_back(fields_of(lines[i]).at(at));
  return result;
}

TEST(LaserLight, PosesAreTheSameInEveryLightUnlessTheSunIsInTheDetector) {
  VERIFIES("LASSO-SIM-067~1");
  const WorkFolder work;
  const std::string noon = telemetry_of(work, kDetector, "10", "", "noon");
  EXPECT_EQ(noon, telemetry_of(work, kDetector, "180", "", "night"));
  const std::string sun = kDetector + "bandpass_nm = 5\nenergy_uJ = 1\nfield_mrad = 1\ngate_us = 200\n";
  EXPECT_EQ(noon, telemetry_of(work, sun, "180", "", "night_too"));  // in the Earth's shadow
  EXPECT_NE(noon, telemetry_of(work, sun, "100", "", "evening"));
  for (const char* out : {"noon", "evening"}) {
    const std::vector<std::string> valid = valid_column(work, out);
    EXPECT_GE(std::count(valid.begin() + 2, valid.end(), "1"), 15) << out;
  }
}

TEST(LaserLight, NoPoseIsValidOnTheReturnsOfACloud) {
  VERIFIES("LASSO-SIM-068~1");
  const WorkFolder work;
  const std::string cloud = "[node.plume]\nmotion = \"before\"\nscatter = {extinction_per_m = 12, radius_m = 0.8}\n";
  telemetry_of(work, "", "10", cloud, "clouded");
  const std::vector<std::string> valid = valid_column(work, "clouded");
  for (std::size_t frame = 2; frame < 7; ++frame) EXPECT_EQ(valid.at(frame), "1") << frame;
  for (std::size_t frame = 12; frame < 20; ++frame) EXPECT_EQ(valid.at(frame), "0") << frame;
  EXPECT_EQ(Json::parse(work.read("out/clouded/results.json")).at("timeline").at("wrong"), 0);
}

TEST(LaserLight, AMaterialOfAPartThatIsNotThereIsRefused) {
  VERIFIES("LASSO-PIC-018~1");
  const WorkFolder work;
  work.write_mission(
      {{"\n[scenario.checked]\n", kDetector + "\n[material.foil]\nparts = \"shrout\"\npreset = \"mli\"\n\n[scenario.checked]\n"}});
  const Answer answer = work.mdat("run missions/test.toml --scenario paper --out out/run");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.err.find("material.foil.parts: \"shrout\": there is no such part"), std::string::npos) << answer.err;
}

}  // namespace
}  // namespace lasso::ft
