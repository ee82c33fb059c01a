// The paper's run in a shortened form, by its results.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::vector<std::pair<std::string, std::string>> kTwoRanges = {
    {"ranges_m = [2.0, 3.0, 4.0, 5.0, 6.0, 7.0]", "ranges_m = [3.0, 4.0]"}};
constexpr int kFrames = 12;
constexpr const char* kVariants[] = {"noise_free", "noisy", "noise_free_hits_only", "noisy_hits_only", "noisy_aimed"};

void expect_sane(const Json& variant, bool noise, double rms_mm, double rms_deg) {
  for (const char* axis : {"x_mm", "y_mm", "z_mm", "yaw_deg", "pitch_deg", "roll_deg"}) {
    EXPECT_LT(std::fabs(variant.at(axis).at("mean").get<double>()), rms_mm) << axis;
    EXPECT_GT(variant.at(axis).at("std").get<double>(), 0) << axis;
  }
  EXPECT_EQ(variant.at("frames"), 2 * kFrames);
  EXPECT_EQ(variant.at("lost"), 0);
  EXPECT_LT(variant.at("rms_mm").get<double>(), rms_mm);
  EXPECT_LT(variant.at("rms_deg").get<double>(), rms_deg);
  EXPECT_GT(variant.at("crlb_mm").get<double>(), 0.02);
  EXPECT_LT(variant.at("crlb_mm").get<double>(), 0.5);
  EXPECT_GT(variant.at("crlb_deg").get<double>(), 0.002);
  EXPECT_LT(variant.at("crlb_deg").get<double>(), 0.1);
  EXPECT_EQ(variant.at("nees").is_null(), !noise);
  const Json& time = variant.at("estimate_us");
  EXPECT_GT(time.at("median").get<double>(), 0);
  EXPECT_LE(time.at("median").get<double>(), time.at("p99").get<double>());
  EXPECT_LE(time.at("p99").get<double>(), time.at("max").get<double>());
  EXPECT_GT(variant.at("filtered").at("rms_mm").get<double>(), 0);
  EXPECT_EQ(variant.at("by_range").size(), 2U);
}

TEST(PaperRun, LeavesResultsReportAndTelemetry) {
  VERIFIES("LASSO-NEED-012~1 LASSO-MDT-004~1 LASSO-GND-030~1 LASSO-SYS-001~2 LASSO-MDT-009~1 LASSO-MDT-010~1");
  const WorkFolder work;
  work.write_mission(kTwoRanges);
  const Answer answer = work.mdat("run missions/test.toml --frames 12 --seed 7 --out out/run");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json results = Json::parse(work.read("out/run/results.json"));
  EXPECT_EQ(results.at("seed"), 7);
  EXPECT_EQ(results.at("scenario"), "paper");
  EXPECT_EQ(results.at("paper_2005").at("z_mm").at("std"), 6.25);
  for (const char* name : kVariants) {
    const bool noise = std::string(name).starts_with("noisy");
    expect_sane(results.at(name), noise, noise ? 0.5 : 0.1, noise ? 0.1 : 0.01);
    EXPECT_TRUE(results.at("side_on").contains(name));
  }
  EXPECT_LT(results.at("noisy_hits_only").at("rms_mm").get<double>(), 2 * results.at("noisy_hits_only").at("crlb_mm").get<double>());

  const std::string report = work.read("out/run/report.html");
  EXPECT_NE(report.find("<svg"), std::string::npos);
  EXPECT_NE(report.find("data:image/png;base64,"), std::string::npos);
  EXPECT_EQ(report.find("src='http"), std::string::npos) << "the report opens offline";
  EXPECT_NE(report.find("bound of the hits</"), std::string::npos) << "the figure's key";
  EXPECT_NE(answer.out.find("paper 2005"), std::string::npos);
  EXPECT_NE(answer.err.find("frames"), std::string::npos) << "progress";
  EXPECT_EQ(answer.err.find('\r'), std::string::npos) << "plain lines where there is no terminal";
}

// Packets of the stream by their length fields (CCSDS 133.0-B-2), 0 if it does not end with a whole one.
std::size_t count_packets(const std::string& stream) {
  std::size_t packets = 0, place = 0;
  while (place + 6 <= stream.size()) {
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(stream[place + i])); };
    place += 7 + (byte(4) << 8 | byte(5));
    ++packets;
  }
  return place == stream.size() ? packets : 0;
}

TEST(PaperRun, IsTheSameForAnyNumberOfJobsAndChangesWithTheSeed) {
  VERIFIES("LASSO-MDT-005~1 LASSO-SYS-029~2");
  const WorkFolder work;
  work.write_mission(kTwoRanges);
  const std::string run = "run missions/test.toml --frames 5 --no-report ";
  ASSERT_EQ(work.mdat(run + "--seed 3 --jobs 1 --out one").exit_code, 0);
  ASSERT_EQ(work.mdat(run + "--seed 3 --jobs 3 --out three").exit_code, 0);
  ASSERT_EQ(work.mdat(run + "--seed 4 --out other").exit_code, 0);
  const std::string stream = work.read("one/telemetry.ccsds");
  EXPECT_EQ(count_packets(stream),
            2U * std::size(kVariants) * 2U * (5U + 4U));  // tables, variants, ranges; poses, and begun, starting, tracking, health
  EXPECT_TRUE(stream == work.read("three/telemetry.ccsds"));
  const Json one = Json::parse(work.read("one/results.json")), three = Json::parse(work.read("three/results.json"));
  for (const char* variant : kVariants) {
    for (const char* figure : {"rms_mm", "rms_deg", "nees", "crlb_mm", "x_mm", "roll_deg"})
      EXPECT_EQ(one.at(variant).at(figure), three.at(variant).at(figure)) << variant << " " << figure;
  }
  EXPECT_FALSE(stream == work.read("other/telemetry.ccsds"));
}

TEST(PaperRun, ReportsARunThatLosesEveryFrame) {
  VERIFIES("LASSO-MDT-002~1 LASSO-MDT-004~1");
  const WorkFolder work;
  work.write_mission({{"step_deg = 1.0\ntilt_deg = 15.0", "step_deg = 100.0\ntilt_deg = 15.0"}, kTwoRanges[0]});
  const Answer answer = work.mdat("run missions/test.toml --frames 3 --out out/run");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(Json::parse(work.read("out/run/results.json")).at("noisy").at("lost"), 6);
  EXPECT_NE(work.read("out/run/report.html").find("every frame is lost"), std::string::npos);
}

TEST(SpinRun, TracksATargetThatMovesWithinItsScans) {
  VERIFIES("LASSO-MDT-004~1");
  const WorkFolder work;
  const Answer answer = work.mdat("run missions/test.toml --scenario spin --frames 30 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const Json results = Json::parse(work.read("out/results.json"));
  const Json& noisy = results.at("noisy");
  EXPECT_FALSE(results.contains("noise_free"));
  EXPECT_EQ(noisy.at("frames"), 30);
  EXPECT_EQ(noisy.at("lost"), 0);
  EXPECT_LT(noisy.at("rms_mm").get<double>(), 1);
  EXPECT_LT(noisy.at("rates").at("rms_degps").get<double>(), 5);
}

// Quaternions of all attitudes in a recording's table of poses.
std::vector<std::string> attitudes(const std::string& csv) {
  std::vector<std::string> result;
  for (const std::string& line : lines_of(csv)) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.at(0) != "scan") result.push_back(fields.at(1) + " " + fields.at(2) + " " + fields.at(3) + " " + fields.at(4));
  }
  return result;
}

TEST(SpinRun, AMotionThatIsDrawnIsAnotherOneForEachRun) {
  VERIFIES("LASSO-MDT-004~1");
  const WorkFolder work;
  const std::string twelve = "ranges_m = [4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0]";
  work.write_mission({{twelve + "\nframes = 60", "ranges_m = [4.0, 4.0]\nframes = 60"}});
  const Answer answer = work.mdat("run missions/test.toml --scenario rates --frames 24 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.out.find("after 20 frames of each run, with noise: lost 0/8, invalid 0"), std::string::npos) << answer.out;
  EXPECT_NE(answer.out.find("attitudes drawn"), std::string::npos) << answer.out;
  const Json noisy = Json::parse(work.read("out/results.json")).at("noisy");
  EXPECT_EQ(noisy.at("settled").at("frames"), 8);
  EXPECT_LT(noisy.at("settled").at("rms_degps").get<double>(), 0.1);
  EXPECT_LT(noisy.at("settled").at("worst_mmps").get<double>(), 10);

  const std::string run = "run missions/test.toml --scenario rates --frames 3 --no-report --force --record ";
  ASSERT_EQ(work.mdat(run + "one.mcap").exit_code, 0);
  ASSERT_EQ(work.mdat(run + "other.mcap --seed 9").exit_code, 0);
  for (const char* name : {"one-4m", "one-4m_2", "other-4m"})
    ASSERT_EQ(work.mdat("recording export " + std::string(name) + ".mcap --format scans -o " + name).exit_code, 0);
  const std::vector<std::string> first = attitudes(work.read("one-4m/truth.csv")), second = attitudes(work.read("one-4m_2/truth.csv"));
  ASSERT_EQ(first.size(), 3U);
  ASSERT_EQ(second.size(), 3U);
  EXPECT_NE(first, second);
  EXPECT_NE(first, attitudes(work.read("other-4m/truth.csv"))) << "the seed tells";
}

TEST(SearchRun, FindsAndTracksTheTargetWithoutAnyPrior) {
  VERIFIES("LASSO-MOD-111~1 LASSO-MDT-004~1");
  const WorkFolder work;
  const int frames = FIXED_POINT ? 110 : 60;  // there a search takes three times as many
  const Answer answer = work.mdat("run missions/test.toml --scenario search --out out --frames " + std::to_string(frames));
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.out.find("found after"), std::string::npos) << answer.out;
  const Json noisy = Json::parse(work.read("out/results.json")).at("noisy");
  int longest = 0;
  for (const Json& range : noisy.at("by_range")) {
    longest = std::max(longest, range.at("frames").get<int>());
    EXPECT_GT(range.at("found_frame").get<int>(), 5);
    EXPECT_LT(range.at("found_frame").get<int>(), FIXED_POINT ? 80 : 50);
    EXPECT_EQ(range.at("lost"), 0) << "tracked from then on";
    EXPECT_EQ(range.at("frames").get<int>() + range.at("found_frame").get<int>(), frames);
  }
  EXPECT_LT(noisy.at("rms_mm").get<double>(), 2);
  const std::string report = work.read("out/report.html");
  EXPECT_NE(report.find("> 40<"), std::string::npos) << "on the axis of frames, of which the longest run has " << longest;
  EXPECT_EQ(report.find("bound of the hits</"), std::string::npos) << "there is none of a target that turns";
}

}  // namespace
}  // namespace lasso::ft
