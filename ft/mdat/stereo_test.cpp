// Ranges from stereo pairs: simulated ones, and a user's own.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr char kPair[] = "stereo missions/test.toml --range 3 --set stereo.pixels=240 --set stereo.samples=2 ";

// Behind a text in what was printed.
double number_after(const std::string& out, const std::string& text) {
  const std::size_t at = out.find(text);
  EXPECT_NE(at, std::string::npos) << text << " in " << out;
  return at == std::string::npos ? 0 : std::stod(out.substr(at + text.size()));
}

TEST(Stereo, WritesAPairItsDisparitiesAndAScan) {
  VERIFIES("LASSO-STE-010~1 LASSO-STE-004~1");
  const WorkFolder work;
  const Answer answer = work.mdat(kPair);
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  for (const char* file : {"left.png", "right.png", "calibration.toml", "disparity.png", "errors.png", "truth.csv", "scans/range.ply"})
    EXPECT_TRUE(std::filesystem::exists(work / ("out/stereo/" + std::string(file)))) << file;
  EXPECT_GT(number_after(answer.out, "valid: "), 50);
  EXPECT_LT(number_after(answer.out, "of the target; "), 2) << "sky";
  EXPECT_LT(number_after(answer.out, "sigma "), 0.4);
  EXPECT_GT(number_after(answer.out, "sigma "), 0.05);
  const Answer again = work.mdat(kPair);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("--force replaces it"), std::string::npos) << again.err;
  const Answer replayed = work.mdat(
      "replay missions/test.toml --scans out/stereo/scans --initial out/stereo/truth.csv --truth out/stereo/truth.csv -o poses.csv --set "
      "sensor.sigma_k_per_m=0.002 --set estimation.silhouettes=false --set estimation.deskew=false --set estimation.kernel_width=4 ");
  if (is_refused_by_fixed_point(replayed)) return;
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  const std::vector<std::string> row = fields_of(lines_of(work.read("poses.csv")).at(1));
  EXPECT_LT(std::stod(row.at(row.size() - 2)), 0.02) << "m from the true pose, a third of a pixel of disparity";
  EXPECT_LT(std::stod(row.back()), 1.0) << "deg";
}

// What the matcher is given is in the folder: given again, it finds the same.
TEST(Stereo, APairOfTheUsersIsMatchedAsTheSimulatedOne) {
  VERIFIES("LASSO-STE-007~1 LASSO-STE-002~1 LASSO-STE-004~1");
  const WorkFolder work;
  const std::string depths = "--nearest 2.3 --farthest 4.5 ";
  ASSERT_EQ(work.mdat(kPair + depths + "-j 1 --out one").exit_code, 0);
  ASSERT_EQ(work.mdat(kPair + depths + "-j 3 --out three").exit_code, 0);
  for (const char* file : {"left.png", "right.png", "disparity.png", "scans/range.ply"})
    EXPECT_EQ(work.read(std::string("one/") + file), work.read(std::string("three/") + file)) << file;
  std::filesystem::rename(work / "one/left.png", work / "L.png");
  std::filesystem::rename(work / "one/right.png", work / "R.png");
  const Answer answer = work.mdat("stereo --left L.png --right R.png --calibration one/calibration.toml --out recorded " + depths);
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  for (const char* file : {"disparity.png", "scans/range.ply"})
    EXPECT_EQ(work.read(std::string("recorded/") + file), work.read(std::string("three/") + file)) << file;
  EXPECT_EQ(work.contents("recorded").size(), 3U) << "and nothing else";
}

TEST(Stereo, RefusesWhatDoesNotFit) {
  VERIFIES("LASSO-STE-007~1");
  const WorkFolder work;
  ASSERT_EQ(work.mdat(kPair + std::string("--out a")).exit_code, 0);
  ASSERT_EQ(work.mdat("stereo missions/test.toml --range 3 --set stereo.pixels=200 --set stereo.plain=true --out b").exit_code, 0);
  const auto refusal = [&](const std::string& arguments) {
    const Answer answer = work.mdat("stereo " + arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments << answer.out;
    EXPECT_EQ(lines_of(answer.err).size(), 1U) << answer.err;
    return answer.err;
  };
  EXPECT_NE(refusal("").find("expected a MISSION, or --left, --right and --calibration"), std::string::npos);
  EXPECT_NE(refusal("--left a/left.png --out c").find("all three"), std::string::npos);
  EXPECT_NE(
      refusal("--left a/left.png --right b/right.png --calibration a/calibration.toml --out c").find("b/right.png: has 200 x 200 pixels"),
      std::string::npos);
  EXPECT_NE(refusal("--left a/left.png --right a/right.png --calibration a/truth.csv --out c").find("a/truth.csv"), std::string::npos);
  EXPECT_NE(refusal("--left a/left.png --right a/truth.csv --calibration a/calibration.toml --out c")
                .find("a/truth.csv: cannot be read as a picture"),
            std::string::npos);
  EXPECT_NE(refusal("--left a/left.png --right a/right.png --calibration a/calibration.toml --nearest 0.1 --farthest 0.2 --out c")
                .find("nothing in common"),
            std::string::npos);
  EXPECT_NE(refusal("--left a/left.png --right a/right.png --calibration a/calibration.toml --nearest 3 --farthest 2 --out c")
                .find("--nearest 3 --farthest 2"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(work / "c"));
}

// The head is a sensor of the mission: each frame has returns of a pair, and the same run gives the same frames.
TEST(Stereo, DrivesTheTrackerOfARun) {
  VERIFIES("LASSO-STE-012~1 LASSO-STE-002~1");
  const WorkFolder work;
  work.write("missions/stereo.toml", read_text(source_path("cfg/missions/hubble_stereo.toml")));
  const std::string run = "run missions/stereo.toml --scenario spin --frames 3 --no-report --set stereo.pixels=240 --set stereo.samples=1 ";
  for (const char* out : {"a", "b"}) {
    const Answer answer = work.mdat(run + "--out " + out);
    if (is_refused_by_fixed_point(answer)) return;
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
  }
  EXPECT_EQ(work.read("a/telemetry.ccsds"), work.read("b/telemetry.ccsds"));
  const std::vector<std::string> lines = lines_of(work.read("a/frames.csv")), names = fields_of(lines.at(0));
  const auto returns = static_cast<std::size_t>(std::find(names.begin(), names.end(), "returns") - names.begin());
  ASSERT_EQ(lines.size(), 4U);
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_GT(std::stoi(fields_of(lines[i]).at(returns)), 100) << lines[i];
}

// Both pictures of each frame, and nothing of the run has changed; without them it is flown again.
TEST(Stereo, ARecordingHasThePictures) {
  VERIFIES("LASSO-REC-045~1 LASSO-REC-003~1");
  const WorkFolder work;
  work.write("missions/stereo.toml", read_text(source_path("cfg/missions/hubble_stereo.toml")));
  const std::string run = "run missions/stereo.toml --scenario spin --frames 2 --no-report --set stereo.pixels=160 --set stereo.samples=1 ";
  const Answer answer = work.mdat(run + "--out all --record all.mcap");
  if (is_refused_by_fixed_point(answer)) return;
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::string info = work.mdat("recording info all.mcap").out;
  for (const char* topic : {"/camera/left/image/compressed", "/camera/left/camera_info", "/camera/right/image/compressed"})
    EXPECT_GE(number_after(info, topic), 2) << info;
  ASSERT_EQ(work.mdat(run + "--out little --record little.mcap --record-for replay").exit_code, 0);
  EXPECT_EQ(work.mdat("recording info little.mcap").out.find("/camera"), std::string::npos);
  EXPECT_EQ(work.read("all/telemetry.ccsds"), work.read("little/telemetry.ccsds"));
  for (const char* file : {"all.mcap", "little.mcap"})
    EXPECT_NE(work.mdat("replay " + std::string(file)).out.find("telemetry: the same as recorded"), std::string::npos) << file;
}

// A mission of fitted errors beside a program without its matcher: OpenCV is not asked for.
TEST(Stereo, FliesByFittedErrorsWithoutPictures) {
  VERIFIES("LASSO-STE-016~1");
  const WorkFolder work;
  work.write("missions/stereo.toml", read_text(source_path("cfg/missions/hubble_stereo.toml")));
  std::filesystem::copy_file(mdat_program(), work / "mdat");
  const std::string run = "cd '" + (work / "").string() +
                          "' && PATH=. ./mdat run missions/stereo.toml --scenario spin --frames 4 --no-report --set stereo.model=fitted "
                          ">out.txt 2>err.txt --out ";
  for (const char* out : {"a", "b"}) {
    const int status = std::system((run + out).c_str());
    if (is_refused_by_fixed_point({WEXITSTATUS(status), work.read("out.txt"), work.read("err.txt")})) return;
    ASSERT_EQ(WEXITSTATUS(status), 0) << work.read("err.txt");
  }
  EXPECT_EQ(work.read("a/telemetry.ccsds"), work.read("b/telemetry.ccsds"));
  const Json results = Json::parse(work.read("a/results.json"));
  EXPECT_NE(work.read("a/results.json").find("stereo.model"), std::string::npos) << "the report tells it";
  EXPECT_EQ(lines_of(work.read("a/frames.csv")).size(), 5U);
}

TEST(Stereo, CampaignsFlyFittedErrorsAndRefusePictures) {
  VERIFIES("LASSO-STE-016~1 LASSO-STE-018~1");
  const WorkFolder work;
  work.write("missions/stereo.toml", read_text(source_path("cfg/missions/hubble_stereo.toml")));
  const std::string campaign =
      "campaign run missions/stereo.toml --campaign light --set campaign.light.cases=4 --set campaign.light.frames=3 --no-report ";
  const Answer refused = work.mdat(campaign + "--out none");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--set stereo.model=fitted"), std::string::npos) << refused.err;
  EXPECT_EQ(lines_of(refused.err).size(), 1U) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(work / "none"));
  for (const char* jobs : {"1", "2"}) {
    const Answer flown = work.mdat(campaign + "--set stereo.model=fitted --jobs " + jobs + " --out by" + jobs);
    ASSERT_EQ(flown.exit_code, 0) << flown.err;
    if (tells_of_fixed_point(flown)) return;  // of each case
  }
  EXPECT_EQ(work.read("by1/results.csv"), work.read("by2/results.csv"));
  EXPECT_EQ(lines_of(work.read("by1/results.csv")).size(), 5U);
}

TEST(Stereo, ItsScansAreDrawnOnPictures) {
  VERIFIES("LASSO-STE-012~1");
  const WorkFolder work;
  work.write("missions/stereo.toml", read_text(source_path("cfg/missions/hubble_stereo.toml")));
  for (const char* model : {"fitted", "rendered"}) {
    const Answer answer = work.mdat(
        "render missions/stereo.toml --scenario spin --time 0.2 --scan --size 96x96 --samples 1 --set stereo.pixels=240 --set "
        "stereo.samples=1 --force --set sensor.sigma_k_per_m=0.005 --set sensor.common_sigma_k_per_m=0.0013 --set stereo.model=" +
        std::string(model));
    if (is_refused_by_fixed_point(answer)) return;
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_GT(number_after(answer.out, "rays, "), 100) << "returns: " << answer.out;
  }
}

TEST(Stereo, SetsFlightsOfBothModelsSideBySide) {
  VERIFIES("LASSO-STE-017~1");
  const WorkFolder work;
  work.write("missions/stereo.toml", read_text(source_path("cfg/missions/hubble_stereo.toml")));
  const std::string flights =
      "stereo missions/stereo.toml --scenario flights --flights 1 --frames 2 --set stereo.pixels=240 --set "
      "stereo.samples=1 --set sensor.sigma_k_per_m=0.005 --set sensor.common_sigma_k_per_m=0.0013 --lights lamp ";
  const Answer both = work.mdat(flights + "--out both");
  if (is_refused_by_fixed_point(both)) return;
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(lines_of(work.read("both/flights.csv")).size(), 1U + 2U + 4U * 2U);
  ASSERT_EQ(work.mdat(flights + "--fitted-only --jobs 3 --out fitted").exit_code, 0);
  const std::string all = work.read("both/flights.csv");
  for (const std::string& line : lines_of(work.read("fitted/flights.csv"))) EXPECT_NE(all.find(line), std::string::npos) << line;
  for (const char* wrong : {"--views 2", "--range 3", "--nearest 1 --farthest 3"}) {
    const Answer refused = work.mdat(flights + wrong);
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_EQ(lines_of(refused.err).size(), 1U) << refused.err;
  }
}

TEST(Stereo, MeasuresManyPairsInStatedLights) {
  VERIFIES("LASSO-STE-014~1");
  const WorkFolder work;
  const std::string trial =
      "stereo missions/test.toml --range 3 --views 2 --set stereo.pixels=240 --set stereo.samples=1 --set sensor.sigma_k_per_m=0.002 --set "
      "estimation.silhouettes=false --set estimation.kernel_width=4 ";
  const Answer answer = work.mdat(trial + "--lights lamp,backlit_no_earth --jobs 2 --out tried");
  if (is_refused_by_fixed_point(answer)) return;
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json lights = Json::parse(work.read("tried/statistics.json")).at("lights");
  ASSERT_EQ(lights.size(), 2U);
  const Json &lamp = lights.at("lamp"), &dark = lights.at("backlit_no_earth");
  EXPECT_EQ(lamp.at("pairs").at("pairs"), 2);
  EXPECT_GT(lamp.at("pairs").at("valid_share").get<double>(), 0.5);
  EXPECT_LT(dark.at("pairs").at("valid_share").get<double>(), 0.1);
  EXPECT_GT(lamp.at("pairs").at("exposure_ms").get<double>(), 10) << "26 W/sr at 3 m";
  EXPECT_EQ(lamp.at("poses").at("scans"), 6);
  EXPECT_EQ(dark.at("poses").at("valid"), 0);
  EXPECT_EQ(lines_of(work.read("tried/poses.csv")).size(), 1U + 12U + 4U * 12U);
  ASSERT_EQ(work.mdat(trial + "--lights lamp --jobs 1 --out again").exit_code, 0);
  const std::string all = work.read("tried/poses.csv");
  for (const std::string& line : lines_of(work.read("again/poses.csv"))) EXPECT_NE(all.find(line), std::string::npos) << line;
  for (const char* wrong : {"--lights lamb", "--time 3", "--nearest 1 --farthest 3"}) {
    const Answer refused = work.mdat(trial + wrong);
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_EQ(lines_of(refused.err).size(), 1U) << refused.err;
  }
}

// mdat by itself, as it is where OpenCV was not there when it was built.
TEST(Stereo, WithoutItsMatcherSaysWhatBringsIt) {
  VERIFIES("LASSO-STE-011~1");
  const WorkFolder work;
  std::filesystem::copy_file(mdat_program(), work / "mdat");
  const std::string command = "cd '" + (work / "").string() + "' && ./mdat " + kPair + ">out.txt 2>err.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(work.read("err.txt").find("make stereo installs the Debian packages libopencv-core-dev"), std::string::npos)
      << work.read("err.txt");
  EXPECT_FALSE(std::filesystem::exists(work / "out/stereo"));
}

}  // namespace
}  // namespace lasso::ft
