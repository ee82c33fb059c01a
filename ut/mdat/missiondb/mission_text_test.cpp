#include "mdat/missiondb/mission_text.hpp"

#include <sstream>

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// The line of `text` that begins with `key`, its words.
std::vector<std::string> words_of(const std::string& text, const std::string& key) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(key + " ", 0) != 0) continue;
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
  }
  return {};
}

std::string check_text_of(const std::filesystem::path& file) {
  MissionSource source = load_mission(file);
  const Mesh target = load_target(source);
  check_target(source, target);
  return check_text(source, target);
}

std::size_t line_of(const std::filesystem::path& file, const std::string& text) {
  std::ifstream stream(file);
  std::size_t number = 1;
  for (std::string line; std::getline(stream, line); ++number) {
    if (line.rfind(text, 0) == 0) return number;
  }
  return 0;
}

TEST(MissionText, InfoShowsEveryValueAndItsOrigin) {
  VERIFIES("LASSO-GND-002~1");
  const MissionSource source = load_mission(kShippedMission);
  const std::string text = info_text(source);
  for (const ParameterRow& row : parameter_rows()) EXPECT_GE(words_of(text, row.key).size(), 4u) << row.key;
  const std::string place = "hubble_tenth.toml:" + std::to_string(line_of(kShippedMission, "points ="));
  const std::vector<std::string> points = words_of(text, "scan.points");
  EXPECT_EQ(points[1], "1024");
  EXPECT_EQ(points[2], place);
  EXPECT_EQ(words_of(text, "scan.margin")[2], "preset");
  EXPECT_EQ(words_of(text, "sensor.fov_half_x_deg")[1], "15");  // in the unit that a person wrote
}

TEST(MissionText, InfoOfAScenarioShowsItsOverrides) {
  VERIFIES("LASSO-GND-002~1 LASSO-GND-010~1");
  const MissionSource source = load_mission(kShippedMission);
  EXPECT_EQ(words_of(info_text(source, "paper"), "estimation.deskew")[1], "false");
  EXPECT_EQ(words_of(info_text(source, "spin"), "estimation.deskew")[1], "true");
  EXPECT_EQ(words_of(info_text(source, "spin"), "scenario.paper.frames").size(), 0u);
  EXPECT_EQ(words_of(info_text(source, "spin"), "scenario.spin.tilt_deg")[1], "15");
}

TEST(MissionText, InfoShowsWhatAScenarioTakesFromItsSensorInItsUnit) {
  VERIFIES("LASSO-GND-002~1");
  const MissionSource source = load_mission(kShippedMission, {"sensor.common_sigma_deg=0.05", "scenario.spin.common_sigma_deg=0.02"});
  EXPECT_EQ(words_of(info_text(source, "tumble"), "scenario.tumble.common_sigma_deg")[1], "0.05");
  EXPECT_EQ(words_of(info_text(source, "spin"), "scenario.spin.common_sigma_deg")[1], "0.02");
}

TEST(MissionText, CheckWarnsOfAStartThatNoSensorReaches) {
  VERIFIES("LASSO-GND-003~1 LASSO-MOD-134~3");
  const Folder folder;
  folder.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n");
  const std::string head =
      "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n[tracking.initial]\npresent = true\n";
  const auto checked = [&](const std::string& text) { return check_text_of(folder.write("m.toml", head + text)); };
  EXPECT_EQ(checked("z_m = 4\n").find("warning"), std::string::npos);
  const std::string far = checked("z_m = 4000\n");
  EXPECT_NE(far.find("m.toml:9:7: tracking.initial.z_m: 4000: the target is wholly outside"), std::string::npos) << far;
  EXPECT_NE(far.find("good: mission 7"), std::string::npos) << "a warning, no more";
  const std::string sensor = "[further_sensor.lidar]\nkind = 'time_of_flight'\nrange_max_m = 5000\nsigma_angle_rad = 1e-4\n";
  EXPECT_EQ(checked("z_m = 4000\n" + sensor).find("warning"), std::string::npos) << checked("z_m = 4000\n" + sensor);
  EXPECT_NE(checked("z_m = 6000\n" + sensor).find("warning"), std::string::npos);
}

TEST(MissionText, CheckSaysWhatIsGood) {
  VERIFIES("LASSO-GND-003~1");
  const std::string text = check_text_of(kShippedMission);
  EXPECT_NE(text.find("good: mission 1 \"Hubble, tenth scale\""), std::string::npos) << text;
  EXPECT_NE(text.find("12 scenarios"), std::string::npos) << text;
}

TEST(MissionText, NothingIsDoubtfulAboutTheShippedMissions) {
  VERIFIES("LASSO-GND-060~1");
  for (const char* name : {"hubble_tenth", "hubble", "hubble_near"}) {
    const std::string text = check_text_of(kSourceFolder / "cfg/missions" / (std::string(name) + ".toml"));
    EXPECT_EQ(text.find("warning"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace lasso::mdat
