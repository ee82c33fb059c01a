// mdat run with the laser camera over its line, as a user sees it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr std::size_t kNoiseFreeFrames = 2 * 3;  // the first variant: two ranges, three frames each
constexpr double kPi = 3.14159265358979323846;

struct Reported {
  bool valid;
  std::array<double, 3> p_m;
  std::array<double, 4> q;
};

// The columns of `mdat decode --format csv` in the order asked for.
std::vector<Reported> decoded(const WorkFolder& folder, const std::string& file) {
  const Answer answer = folder.mdat("decode " + file + " --format csv --items valid,p_sensor_target_m,q_sensor_target");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  std::istringstream lines(answer.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.find("offset,sequence_count,time_s,valid,q_sensor_target_0"), 0U) << line;
  std::vector<Reported> all;
  while (std::getline(lines, line)) {
    std::vector<std::string> fields;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) fields.push_back(word);
    const auto real = [&](std::size_t k) { return std::stod(fields.at(k)); };
    all.push_back({fields.at(3) == "yes", {real(8), real(9), real(10)}, {real(4), real(5), real(6), real(7)}});
  }
  return all;
}

double apart_m(const Reported& a, const Reported& b) { return std::hypot(a.p_m[0] - b.p_m[0], a.p_m[1] - b.p_m[1], a.p_m[2] - b.p_m[2]); }
double apart_deg(const Reported& a, const Reported& b) {
  const double cosine = std::fabs(a.q[0] * b.q[0] + a.q[1] * b.q[1] + a.q[2] * b.q[2] + a.q[3] * b.q[3]);
  return 2 * std::acos(std::fmin(1.0, cosine)) * 180 / kPi;
}

struct Head {
  const char *sensor, *kind;
};
class Line : public ::testing::TestWithParam<Head> {};

TEST_P(Line, GivesThePosesOfTheSimulatedSensor) {
  VERIFIES("LASSO-LCS-010~4 LASSO-LCS-016~2");
  const WorkFolder folder;
  folder.write_mission({{"ranges_m = [2.0, 3.0, 4.0, 5.0, 6.0, 7.0]", "ranges_m = [3.0, 7.0]"},
                        {"sigma0_m = 1e-5\n", "sigma0_m = 1e-5\nkind = \"" + std::string(GetParam().kind) + "\"\n"}});
  for (const std::string sensor : {"simulated", GetParam().sensor}) {
    const Answer answer = folder.mdat("run missions/test.toml --frames 3 --no-report --sensor " + sensor + " --out " + sensor);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
  }
  const std::vector<Reported> straight = decoded(folder, "simulated/telemetry.ccsds"),
                              line = decoded(folder, std::string(GetParam().sensor) + "/telemetry.ccsds");
  ASSERT_EQ(straight.size(), line.size());
  ASSERT_GE(straight.size(), kNoiseFreeFrames);
  for (std::size_t i = 0; i < straight.size(); ++i) EXPECT_EQ(straight[i].valid, line[i].valid) << i;
  for (std::size_t i = 0; i < kNoiseFreeFrames; ++i) {
    const Reported &a = straight[i], &b = line[i];
    EXPECT_LT(apart_m(a, b), 2e-5) << i;
    EXPECT_LT(apart_deg(a, b), 0.002) << i;
    EXPECT_TRUE(a.p_m != b.p_m) << "the line was not used";
  }
}

// Noise ends with the counts of mirrors and detector, which the simulated sensor rounds to as the camera does.
TEST(NoisyLine, GivesThePosesOfTheSimulatedSensor) {
  VERIFIES("LASSO-LCS-010~4");
  const WorkFolder folder;
  for (const std::string sensor : {"simulated", "lcs-wire"}) {
    const Answer answer =
        folder.mdat("run missions/test.toml --scenario spin --frames 100 --no-report --sensor " + sensor + " --out " + sensor);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
  }
  const std::vector<Reported> straight = decoded(folder, "simulated/telemetry.ccsds"), line = decoded(folder, "lcs-wire/telemetry.ccsds");
  ASSERT_EQ(straight.size(), line.size());
  ASSERT_GE(straight.size(), 98U);
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_EQ(straight[i].p_m, line[i].p_m) << i;
    EXPECT_EQ(straight[i].q, line[i].q) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Line,
                         ::testing::Values(Head{"lcs-wire", "laser_camera"}, Head{"lidar-wire", "time_of_flight"},
                                           Head{"tridar-wire", "laser_camera"}),
                         [](const auto& one) { return std::string(one.param.sensor).substr(0, 3); });

TEST(RecordedRun, GivesThePosesOfTheRunThatWasRecorded) {
  VERIFIES("LASSO-SNS-031~1");
  const WorkFolder folder;
  const std::string run = "run missions/test.toml --scenario spin --frames 6 --no-report ";
  ASSERT_EQ(folder.mdat(run + "--out first --record scans.mcap --force").exit_code, 0);
  ASSERT_EQ(folder.mdat(run + "--out again --seed 77 --sensor replay:scans.mcap").exit_code, 0);
  const std::string telemetry = folder.read("first/telemetry.ccsds");
  EXPECT_FALSE(telemetry.empty());
  EXPECT_TRUE(telemetry == folder.read("again/telemetry.ccsds")) << "another seed draws other noise: it was not the recording that played";
}

TEST(RecordedRun, WarnsOfARunThatIsLongerThanItsRecording) {
  VERIFIES("LASSO-SNS-031~1");
  const WorkFolder folder;
  const std::string run = "run missions/test.toml --scenario spin --no-report ";
  ASSERT_EQ(folder.mdat(run + "--frames 3 --out first --record scans.mcap --force").exit_code, 0);
  const Answer fits = folder.mdat(run + "--frames 3 --out again --sensor replay:scans.mcap"),
               longer = folder.mdat(run + "--frames 8 --out longer --sensor replay:scans.mcap");
  EXPECT_EQ(fits.err.find("warning: --sensor replay"), std::string::npos) << fits.err;
  EXPECT_NE(longer.err.find("scans are not in the recording, and were lost: it is shorter than the run"), std::string::npos) << longer.err;
}

TEST(RecordedRun, SaysWhatIsWrongWithARecording) {
  VERIFIES("LASSO-SNS-031~1");
  const WorkFolder folder;
  folder.write("scans.mcap", "no recording");
  const std::pair<const char*, const char*> cases[] = {
      {"--scenario spin --sensor replay:none", "none: cannot be read"},
      {"--scenario spin --sensor replay:scans.mcap", "scans.mcap: is no MCAP file"},
      {"--scenario spin --sensor replay:scans.3dlr", "--sensor replay:scans.3dlr: recordings are FILE.mcap now"},
      {"--scenario spin --sensor replay:", "replay:FILE"},
      {"--scenario spin --record-sensor made.3dlr", "--record-sensor made.3dlr: is --record FILE.mcap now"},
      {"--scenario spin --record scans", "--record scans: expected FILE.mcap"},
  };
  for (const auto& [words, why] : cases) {
    const Answer answer = folder.mdat("run missions/test.toml --frames 2 --no-report " + std::string(words));
    EXPECT_EQ(answer.exit_code, 2) << words;
    EXPECT_NE(answer.err.find(why), std::string::npos) << answer.err;
  }
}

TEST(LineRefusals, NameWhatTheMissionLacks) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"--sensor lidar-wire", "--sensor lidar-wire: none of the mission's sensors is a LIDAR"},
      {"--sensor lidar-wire --calibration missions/test.toml", "--sensor lcs-wire or tridar-wire"},
      {"--sensor tridar", "expected simulated, or lcs-wire, lidar-wire or tridar-wire"},
  };
  for (const auto& [words, why] : cases) {
    const Answer answer = folder.mdat("run missions/test.toml " + std::string(words));
    EXPECT_EQ(answer.exit_code, 2) << words;
    EXPECT_NE(answer.err.find(why), std::string::npos) << answer.err;
  }
}

TEST(LineRefusals, OneLineHasOneHead) {
  VERIFIES("LASSO-MDT-007~1");
  const WorkFolder folder;
  const auto refusal = [&](const char* second_kind, const char* sensor) {
    folder.write_mission({{"[scan]\n", "[further_sensor.second]\nkind = \"" + std::string(second_kind) +
                                           "\"\nuse_from_m = 0.0\nuse_to_m = 10.0\n\n[scan]\n"},
                          {"fov_half_y_deg = 15.0\n", "fov_half_y_deg = 15.0\nuse_from_m = 5.0\nuse_to_m = 12.0\n"}});
    const Answer answer = folder.mdat("run missions/test.toml --scenario spin --frames 2 --no-report --sensor " + std::string(sensor));
    EXPECT_EQ(answer.exit_code, 2) << answer.err;
    return answer.err;
  };
  EXPECT_NE(refusal("laser_camera", "lcs-wire:unix:none").find("2 of the mission's sensors would be at the end of one line"),
            std::string::npos);
  EXPECT_NE(refusal("time_of_flight", "tridar-wire:unix:none").find("--sensor tridar-wire:unix:none: 2 of"), std::string::npos);
  EXPECT_NE(refusal("time_of_flight", "lcs-wire:unix:none").find("unix:none: not there"), std::string::npos) << "one of each kind";
}

TEST(LineRefusals, ASensorThatThereIsNotIsRefused) {
  const WorkFolder folder;
  const Answer answer = folder.mdat("run missions/test.toml --sensor radar");
  EXPECT_NE(answer.exit_code, 0);
  EXPECT_NE(answer.err.find("--sensor"), std::string::npos) << answer.err;
}

}  // namespace
}  // namespace lasso::ft
