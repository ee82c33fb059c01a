// What the command line sets in a mission's place, what it does not replace, and two results side by side.
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::string kSpin = "run missions/test.toml --scenario spin --frames 3 --no-report ";

TEST(Setting, HoldsInPlaceOfTheFilesAndIsNamed) {
  VERIFIES("LASSO-MDT-031~1");
  const WorkFolder work;
  const Answer answer =
      work.mdat(kSpin + "--set scan.points=512 --set scan.pattern=lissajous --set scenario.spin.ranges_m='[3.5]' --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json results = Json::parse(work.read("out/results.json"));
  EXPECT_EQ(results.at("set"), (std::vector<std::string>{"scan.points=512", "scan.pattern=lissajous", "scenario.spin.ranges_m=[3.5]"}));
  EXPECT_EQ(results.at("settings").at("scan.points"), 512);
  EXPECT_EQ(results.at("settings").at("scan.pattern"), "lissajous");
  EXPECT_EQ(results.at("settings").at("scan.margin"), 1) << "a preset";
  EXPECT_EQ(results.at("noisy").at("by_range").at(0).at("range_m"), 3.5);
  EXPECT_NE(answer.out.find("at 3.5 m"), std::string::npos) << answer.out;
}

// Not the preset's value again, nor one that an option of its own replaces.
TEST(Setting, ThatChangesNothingIsTold) {
  VERIFIES("LASSO-MDT-031~1");
  const WorkFolder work;
  const Answer idle =
      work.mdat(kSpin + "--set scan.margin=1.0 --set scan.points=512 --set mission.name=other --set scenario.spin.frames=5 --out out");
  EXPECT_EQ(idle.exit_code, 0) << idle.err;
  EXPECT_NE(idle.err.find("note: --set scan.margin=1.0: changes nothing: the value is the same without it\n"), std::string::npos)
      << idle.err;
  EXPECT_EQ(idle.err.find("scan.points"), std::string::npos) << idle.err;
  EXPECT_EQ(idle.err.find("mission.name"), std::string::npos) << idle.err;
  EXPECT_NE(idle.err.find("warning: --set scenario.spin.frames: has no effect beside --frames, which holds\n"), std::string::npos)
      << idle.err;
  EXPECT_EQ(Json::parse(work.read("out/results.json")).at("frames"), 3);
}

TEST(Setting, IsCheckedAsTheFilesKeysAre) {
  VERIFIES("LASSO-MDT-031~1");
  const WorkFolder work;
  const std::pair<const char*, const char*> cases[] = {
      {"scan.pionts=512", "mdat: --set: scan.pionts: unknown key; did you mean scan.points?"},
      {"points=512", "mdat: --set: points: unknown key; did you mean scan.points?"},
      {"scna.points=512", "mdat: --set: scna: unknown key; did you mean scan?"},
      {"scan.points=5000", "mdat: --set: scan.points: 5000: out of range: expected a whole number from "},
      {"scan.points=many", "mdat: --set: scan.points: 'many': wrong type: "},
      {"scan.points=", "mdat: --set: scan.points: '': wrong type: "},
      {"scan.pattern=rosete", "did you mean \"rosette\"?"},
      {"scan.points", "mdat: --set: scan.points: expected KEY=VALUE, such as scan.points=512"},
      {"=3", "mdat: --set: =3: expected KEY=VALUE"},
      {"scan.points.x=1", "mdat: --set: scan.points.x: 1: unknown key"},
      {"scenario.paper.frames=3", "mdat: --set: scenario.paper.frames: changes nothing: the scenario is spin"},
      {"scenario.sipn.frames=3", "mdat: --set: scenario.sipn"},
      {"sensor.range_min_m=20", "mdat: --set: sensor.range_m"}};
  const std::vector<std::string> before = work.contents();
  for (const auto& [setting, expected] : cases) {
    const Answer answer = work.mdat(kSpin + "--out out --set '" + setting + "'");
    EXPECT_EQ(answer.exit_code, 2) << setting << answer.err;
    EXPECT_NE(answer.err.find(expected), std::string::npos) << answer.err;
    EXPECT_EQ(work.contents(), before) << setting;
  }
  const Answer overridden = work.mdat("mission compile missions/test.toml --scenario paper --set estimation.deskew=true");
  EXPECT_EQ(overridden.err,
            "mdat: --set: estimation.deskew: changes nothing: the scenario overrides it; set "
            "scenario.paper.override.estimation.deskew\n");
}

TEST(Setting, GoesIntoAnImageAndAReplayWhereItIsNotCompiled) {
  VERIFIES("LASSO-MDT-031~1");
  const WorkFolder work;
  ASSERT_EQ(work.mdat("mission compile missions/test.toml --set scan.points=512 -o a.3dli").exit_code, 0);
  EXPECT_NE(work.mdat("mission info a.3dli").out.find("scan.points                                512"), std::string::npos);
  work.record_scans(kSpin + "--set scan.points=512", "scans/4m");
  EXPECT_EQ(lines_of(work.read("scans/4m/scans/f00000.csv")).size(), 513U);
  const std::string replay = " --scans scans/4m/scans --initial scans/4m/poses.csv --set tracking.inliers_min=600 --out poses.csv";
  const Answer image = work.mdat("replay a.3dli" + replay);
  EXPECT_EQ(image.err, "mdat: --set tracking.inliers_min=600: a.3dli is a flight image, whose values are fixed; give its mission\n");
  const Answer mission = work.mdat("replay missions/test.toml" + replay);
  ASSERT_EQ(mission.exit_code, 0) << mission.err;
  EXPECT_EQ(work.read("poses.csv").find(",1,ok"), std::string::npos) << "512 rays have no 600 inliers: " << work.read("poses.csv");
}

TEST(EarlierFiles, AreReplacedOnlyWhenToldSo) {
  VERIFIES("LASSO-MDT-032~1");
  const WorkFolder work;
  work.write("out/report.html", "earlier");
  work.write("picture.png", "earlier");
  work.write("picture.mcap", "earlier");
  const std::pair<std::string, std::string> cases[] = {
      {kSpin + "--out out", "mdat: out/report.html: is there since "},
      {kSpin + "--out other --picture picture.png", "mdat: picture.png: is there since "},
      {kSpin + "--out other --record picture.mcap", "mdat: picture.mcap: is there since "},
      {"mission compile missions/test.toml -o picture.png", "mdat: picture.png: is there since "}};
  const std::vector<std::string> before = work.contents();
  for (const auto& [command, expected] : cases) {
    const Answer answer = work.mdat(command);
    EXPECT_EQ(answer.exit_code, 2) << command;
    EXPECT_EQ(answer.err.find(expected), 0U) << answer.err;
    EXPECT_NE(answer.err.find("--force"), std::string::npos) << answer.err;
    EXPECT_EQ(work.contents(), before) << command;
  }
  ASSERT_EQ(work.mdat(kSpin + "--out out --force").exit_code, 0);
  EXPECT_EQ(work.contents("out"), (std::vector<std::string>{"frames.csv", "results.json", "telemetry.ccsds"}))
      << "no report of another run stays";
}

TEST(EarlierFiles, OfARecordingAndAReplay) {
  VERIFIES("LASSO-MDT-032~1");
  const WorkFolder work;
  const std::string record = "run missions/test.toml --scenario spin --no-report --force --record run.mcap --frames ",
                    scans = "recording export run.mcap --format scans -o scans/4m";
  ASSERT_EQ(work.mdat(record + "3").exit_code, 0);
  ASSERT_EQ(work.mdat(scans).exit_code, 0);
  ASSERT_EQ(work.mdat(record + "2").exit_code, 0);
  EXPECT_EQ(work.mdat(scans).exit_code, 2);
  ASSERT_EQ(work.mdat(scans + " --force").exit_code, 0);
  EXPECT_EQ(work.contents("scans/4m/scans"), (std::vector<std::string>{"f00000.csv", "f00001.csv"}))
      << "the third was of the first recording";
  const std::string replay = "replay missions/test.toml --scans scans/4m/scans --initial scans/4m/poses.csv --out poses.csv";
  ASSERT_EQ(work.mdat(replay).exit_code, 0);
  EXPECT_EQ(work.mdat(replay).exit_code, 2);
  EXPECT_EQ(work.mdat(replay + " --force").exit_code, 0);
  ASSERT_EQ(work.mdat("mission compile missions/test.toml").exit_code, 0);
  EXPECT_NE(work.mdat("mission compile missions/test.toml").out.find("is replaced"), std::string::npos)
      << "an image is made from its mission";
}

// Words of the line that begins with `title`, behind it.
std::string behind(const std::string& text, const std::string& title) {
  for (const std::string& line : lines_of(text)) {
    if (line.find("  " + title + " ") != 0) continue;
    return line.substr(line.find_first_not_of(' ', title.size() + 2));
  }
  return "none";
}

TEST(Compare, PrintsTwoResultsSideBySide) {
  VERIFIES("LASSO-MDT-033~1");
  const WorkFolder work;
  work.write("a/results.json", R"({"mission": "m", "scenario": "s", "seed": 1, "settings": {"scan.points": 1024, "scan.pattern": "rosette"},
    "noisy": {"frames": 8, "lost": 0, "invalid": 1, "rms_mm": 0.5, "nees": 6.0, "estimate_us": {"median": 200}},
    "noise_free": {"frames": 8, "lost": 0, "nees": null}})");
  work.write("b/results.json", R"({"mission": "m", "scenario": "s", "seed": 2, "settings": {"scan.points": 512, "scan.pattern": "rosette"},
    "noisy": {"frames": 8, "lost": 2, "invalid": 3, "rms_mm": 1.5, "nees": 7.5, "estimate_us": {"median": 50}},
    "timeline": {"frames": 4, "valid": 4}})");
  const Answer answer = work.mdat("compare a b/results.json");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.err, "");
  EXPECT_EQ(behind(answer.out, "seed"), "1    2");
  EXPECT_EQ(behind(answer.out, "scan.points"), "1024  512");
  EXPECT_EQ(behind(answer.out, "scan.pattern"), "none") << "the same in both";
  EXPECT_LT(answer.out.find("scan.points"), answer.out.find("rms, mm")) << "settings first";
  EXPECT_EQ(behind(answer.out, "rms, mm"), "0.5000  1.5000     3");
  EXPECT_EQ(behind(answer.out, "lost"), "0       2     -") << "no ratio over nothing";
  EXPECT_EQ(behind(answer.out, "estimate, median us"), "200      50  0.25");
  EXPECT_NE(answer.out.find("noise_free (in A alone)"), std::string::npos);
  EXPECT_NE(answer.out.find("timeline (in B alone)"), std::string::npos);
}

TEST(Compare, RefusesWhatIsNoResult) {
  VERIFIES("LASSO-MDT-033~1 LASSO-MDT-007~1");
  const WorkFolder work;
  work.write("a/results.json", R"({"mission": "m", "scenario": "s"})");
  EXPECT_EQ(work.mdat("compare a a").out, "A: a\nB: a\n\nsettings: all the same\n");
  for (const char* text : {"", "{", "[]", "{\"mission\": 1}"}) {
    work.write("b.json", text);
    const Answer answer = work.mdat("compare a b.json");
    EXPECT_EQ(answer.exit_code, 2) << text;
    EXPECT_EQ(answer.err, "mdat: b.json: not the results of mdat run; give its folder, or the results.json in it\n");
  }
  EXPECT_EQ(work.mdat("compare a missions").err, "mdat: missions/results.json: no such file\n");
}

// What is valid is written, with its comments; what is not leaves the file as it was.
TEST(MissionSet, WritesWhatIsValidAndNothingElse) {
  VERIFIES("LASSO-GND-146~1");
  const WorkFolder work;
  const std::string before = work.read("missions/test.toml");
  const std::pair<const char*, const char*> refused[] = {
      {"scan.pionts=512", "mdat: mission set: scan.pionts: unknown key; did you mean scan.points?"},
      {"scan.points=512 scan.points=5", "mdat: mission set: scan.points: 5: out of range"},
      {"sensor.range_min_m=20", "mdat: mission set: sensor.range_m"},
      {"scan=5", "scan: 5: wrong type: expected a table [scan]"}};
  for (const auto& [settings, expected] : refused) {
    const Answer answer = work.mdat("mission set missions/test.toml " + std::string(settings));
    EXPECT_EQ(answer.exit_code, 2) << settings;
    EXPECT_NE(answer.err.find(expected), std::string::npos) << answer.err;
    EXPECT_EQ(work.read("missions/test.toml"), before) << settings;
  }
  EXPECT_NE(work.mdat("mission set missions/test.toml scan.points=512 --dry-run").out.find(": would change so\n"), std::string::npos);
  EXPECT_EQ(work.read("missions/test.toml"), before);
  const Answer done = work.mdat("mission set missions/test.toml scan.points=512");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find(": +points = 512"), std::string::npos) << done.out;
  EXPECT_NE(work.mdat("mission info missions/test.toml").out.find("scan.points                              512"), std::string::npos);
  EXPECT_NE(work.mdat("mission set missions/test.toml scan.points=512").out.find("says so already"), std::string::npos);
}

TEST(MissionDiff, OfMissionsAndImagesIsInUnits) {
  VERIFIES("LASSO-GND-148~2");
  const WorkFolder work;
  work.write("missions/other.toml", work.read("missions/test.toml"));
  const Answer set = work.mdat(
      "mission set missions/other.toml sensor.sigma0_m=0.00002 scenario.spin.frames=9 scenario.spin.override.tracking.coast_frames=7");
  ASSERT_EQ(set.exit_code, 0) << set.err;
  const Answer diff = work.mdat("mission diff missions/test.toml missions/other.toml");
  EXPECT_EQ(lines_of(diff.out).size(), 4U) << diff.out;
  for (const char* expected : {"2e-05 m", "scenario.spin.frames", "scenario.spin.override.tracking.coast_frames  -"})
    EXPECT_NE(diff.out.find(expected), std::string::npos) << diff.out;
  ASSERT_EQ(work.mdat("mission compile missions/test.toml -o a.3dli").exit_code, 0);
  EXPECT_EQ(lines_of(work.mdat("mission diff missions/test.toml a.3dli").out).front(), "no value differs");
  EXPECT_NE(work.mdat("mission diff a.3dli missions/other.toml").out.find("2e-05 m"), std::string::npos);
  EXPECT_EQ(work.mdat("mission diff a.3dli missions/none.toml").exit_code, 2);
}

// Of each table of a mission a value is changed: it is told, and nothing else.
TEST(MissionDiff, TellsAValueOfEachTable) {
  VERIFIES("LASSO-GND-148~2");
  const WorkFolder work;
  struct Changed {
    const char *key, *value, *told;
  };
  const Changed changes[] = {{"mission.id", "7", "7"},
                             {"mission.version", "99", "99"},
                             {"mission.name", "another", "\"another\""},
                             {"target.crease_angle_deg", "35", "35 deg"},
                             {"sensor.dropout_probability", "0.25", "0.25"},
                             {"scan.points", "512", "512"},
                             {"filter.period_s", "0.4", "0.4 s"},
                             {"start.age_max_s", "30", "30 s"},
                             {"tracking.initial.z_m", "4.5", "4.5 m"},
                             {"scenario.spin.frames", "9", "9"},
                             {"scenario.spin.override.tracking.coast_frames", "7", "7"},
                             {"material.hull.preset", "mli", "\"mli\""},
                             {"campaign.montecarlo.cases", "3", "3"},
                             {"campaign.montecarlo.truth.prior_turn_deg", "[1, 2, 3]", "[1, 2, 3]"},
                             {"campaign.montecarlo.criteria.no_wrong_pose.share_min", "0.9", "0.9"}};
  work.write_mission({{"[scenario.paper]", "[material.hull]\nparts = [\"body\"]\npreset = \"white-paint\"\n\n[scenario.paper]"}});
  for (const Changed& changed : changes) {
    work.write("missions/other.toml", work.read("missions/test.toml"));
    const Answer set = work.mdat("mission set missions/other.toml " + std::string(changed.key) + "='" + changed.value + "'");
    ASSERT_EQ(set.exit_code, 0) << set.err;
    const std::vector<std::string> lines = lines_of(work.mdat("mission diff missions/test.toml missions/other.toml").out);
    ASSERT_EQ(lines.size(), 2U) << changed.key << ": " << lines.back();
    EXPECT_EQ(lines[1].rfind("  " + std::string(changed.key) + " ", 0), 0U) << lines[1];
    EXPECT_EQ(lines[1].substr(lines[1].find_last_not_of(' ') + 1 - std::string(changed.told).size()), changed.told) << lines[1];
  }
  ASSERT_EQ(work.mdat("mission compile missions/test.toml -o a.3dli").exit_code, 0);
  ASSERT_EQ(work.mdat("mission compile missions/test.toml --set mission.version=2 --set mission.id=8 -o b.3dli").exit_code, 0);
  const std::vector<std::string> images = lines_of(work.mdat("mission diff a.3dli b.3dli").out);
  ASSERT_EQ(images.size(), 4U);
  EXPECT_EQ(images[1].rfind("  mission.id ", 0), 0U) << images[1];
  EXPECT_EQ(images[2].rfind("  mission.version ", 0), 0U) << images[2];
}

TEST(MissionExplain, SaysWhereAValueCameFrom) {
  VERIFIES("LASSO-GND-147~1");
  const WorkFolder work;
  const Answer answer = work.mdat("mission explain scan.points missions/test.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  for (const char* expected : {"rays of one scan", "a whole number from 64 to 4096", "1024  (test.toml:"})
    EXPECT_NE(answer.out.find(expected), std::string::npos) << answer.out;
  const Answer unknown = work.mdat("mission explain points");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("did you mean scan.points?"), std::string::npos) << unknown.err;
  const Answer old = work.mdat("mission explain start.gate");
  EXPECT_EQ(old.exit_code, 2);
  EXPECT_EQ(old.err, "mdat: mission explain: start.gate: is 25 in every mission: leave it out\n");
}

}  // namespace
}  // namespace lasso::ft
