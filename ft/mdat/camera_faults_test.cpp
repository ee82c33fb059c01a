// Tracking while the simulated laser camera and its line fail by a script, as a user sees it: 360 frames each, 72 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using Counters = std::map<std::string, long>;

struct Outcome {
  long wrong = -1, lost = -1, invalid = -1, frames = 0;
  long lost_scans = -1;  // of the pose packets
  Counters sensor;       // the last packet `sensor`; empty without one

  long of(const std::string& item) const {
    const auto found = sensor.find(item);
    return found == sensor.end() ? 0 : found->second;
  }
};

std::vector<std::string> csv_columns(const WorkFolder& folder, const std::string& options, std::vector<std::string>& last) {
  const Answer answer = folder.mdat("decode run/telemetry.ccsds --format csv " + options);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const std::vector<std::string> lines = lines_of(answer.out);
  if (lines.size() < 2) return {};
  last = fields_of(lines.back());
  return fields_of(lines.front());
}

Counters last_of(const WorkFolder& folder, const std::string& options) {
  std::vector<std::string> last;
  const std::vector<std::string> names = csv_columns(folder, options, last);
  Counters counters;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!last.at(i).empty() && last[i].find_first_not_of("0123456789") == std::string::npos) counters[names[i]] = std::stol(last[i]);
  }
  return counters;
}

Outcome fly(const std::string& script) {
  const WorkFolder folder;
  folder.write("faults.toml", script);
  const Answer answer = folder.mdat(
      "run missions/test.toml --scenario spin --frames 360 --no-report --sensor lcs-wire --camera-faults faults.toml --out run");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const Json run = Json::parse(folder.read("run/results.json")).at("noisy");
  Outcome outcome{run.at("wrong"), run.at("lost"), run.at("invalid"), run.at("frames"), 0, {}};
  outcome.lost_scans = last_of(folder, "--packet pose --items lost_scans").at("lost_scans");
  outcome.sensor = last_of(folder, "--packet sensor");
  return outcome;
}

struct Case {
  const char* name;
  const char* script;
  const char* counter;  // that says what went wrong, and its least value
  long least;
  long lost_min, lost_max;      // scans
  const char* cause = nullptr;  // of all of them
};

class CameraFaults : public ::testing::TestWithParam<Case> {};

TEST_P(CameraFaults, NeverMakeAWrongPoseAndAreCountedWithTheirCause) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-012~1 LASSO-SIM-032~1");
  const Case& expected = GetParam();
  const Outcome outcome = fly(expected.script);
  EXPECT_EQ(outcome.frames, 360);
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_GE(outcome.of(expected.counter), expected.least);
  EXPECT_EQ(outcome.of("lost"), outcome.lost_scans) << "what is lost has a cause";
  long causes = 0;
  for (const auto& [name, count] : outcome.sensor) causes += name.rfind("lost_", 0) == 0 ? count : 0;
  EXPECT_EQ(outcome.of("lost"), causes);
  EXPECT_GE(outcome.lost_scans, expected.lost_min);
  EXPECT_LE(outcome.lost_scans, expected.lost_max);
  if (expected.cause != nullptr) {
    EXPECT_EQ(outcome.of(expected.cause), outcome.lost_scans);
  }
  EXPECT_LE(outcome.lost, outcome.lost_scans) << "each scan that was not lost was tracked";
}

constexpr Case kCases[] = {
    {"dropped", "[[fault]]\nkind = 'drop'\nfrom_s = 2\nto_s = 70\nprobability = 0.1\n", "missing_frames", 5000, 0, 0},
    {"repeated", "[[fault]]\nkind = 'repeat'\nfrom_s = 2\nto_s = 70\nprobability = 0.1\n", "repeated_frames", 5000, 0, 0},
    {"corrupted", "[[fault]]\nkind = 'corrupt'\nfrom_s = 2\nto_s = 70\nprobability = 0.05\n", "damaged_frames", 3000, 0, 0},
    {"late", "[[fault]]\nkind = 'late'\nfrom_s = 2\nto_s = 40\ndelay_s = 0.03\n", "strayed", 5000, 0, 0},
    {"too_late", "[[fault]]\nkind = 'late'\nfrom_s = 20.1\nto_s = 20.9\ndelay_s = 0.12\n", "lost_silent", 3, 3, 6, nullptr},
    {"silent", "[[fault]]\nkind = 'silent'\nfrom_s = 20\nto_s = 21.5\n", "lost_silent", 7, 7, 9, "lost_silent"},
    {"stuck_mirror", "[[fault]]\nkind = 'stuck_mirror'\nfrom_s = 20.13\nto_s = 20.85\n", "off_plan", 64, 4, 5, "lost_off_plan"},
    {"saturated", "[[fault]]\nkind = 'saturated'\nfrom_s = 20.1\nto_s = 20.7\n", "samples_refused", 900, 0, 0},
    {"clock_jumps",
     "[[fault]]\nkind = 'clock_jump'\nfrom_s = 20.1\njump_s = -1.7\n[[fault]]\nkind = 'clock_jump'\nfrom_s = 30.1\njump_s = 0.2\n",
     "clock_jumps", 2, 0, 0},
    {"clock_rate", "[[fault]]\nkind = 'clock_rate'\nfrom_s = 20\nto_s = 24\nrate = 0.05\n", "bad_times", 5000, 0, 0},
    {"reset", "[[fault]]\nkind = 'reset'\nfrom_s = 20.1\n[[fault]]\nkind = 'reset'\nfrom_s = 40.15\n", "restarts", 2, 4, 6},
    {"bit_errors", "[[fault]]\nkind = 'bit_errors'\nfrom_s = 0\nto_s = 72\nrate = 1e-4\n", "damaged_frames", 3000, 1, 36, "lost_silent"},
    {"everything",
     "[[fault]]\nkind = 'bit_errors'\nfrom_s = 0\nto_s = 72\nrate = 1e-4\n"
     "[[fault]]\nkind = 'drop'\nfrom_s = 2\nto_s = 70\nprobability = 0.05\n"
     "[[fault]]\nkind = 'silent'\nfrom_s = 10\nto_s = 10.5\n"
     "[[fault]]\nkind = 'stuck_mirror'\nfrom_s = 20.13\nto_s = 20.85\n"
     "[[fault]]\nkind = 'late'\nfrom_s = 30\nto_s = 40\ndelay_s = 0.03\n"
     "[[fault]]\nkind = 'saturated'\nfrom_s = 50.1\nto_s = 50.7\n"
     "[[fault]]\nkind = 'reset'\nfrom_s = 60.1\n"
     "[[fault]]\nkind = 'clock_jump'\nfrom_s = 65.1\njump_s = 1\n",
     "samples_lost", 10000, 10, 50},
};
INSTANTIATE_TEST_SUITE_P(All, CameraFaults, ::testing::ValuesIn(kCases), [](const auto& one) { return std::string(one.param.name); });

TEST(CameraFaultScript, WhatItCannotMeanIsRefusedWithItsPlace) {
  VERIFIES("LASSO-SIM-032~1");
  const std::pair<const char*, const char*> cases[] = {
      {"[[fault]]\nkind = 'explode'\nfrom_s = 1\n", "faults.toml:2:8: fault[0].kind: 'explode'"},
      {"[[fault]]\nfrom_s = 1\n", "fault[0].kind"},
      {"[[fault]]\nkind = 'drop'\nfrom_s = 1\nto_s = 2\n", "fault[0].probability"},
      {"[[fault]]\nkind = 'drop'\nfrom_s = 1\nto_s = 2\nprobability = 1.5\n", "faults.toml:5:15: fault[0].probability"},
      {"[[fault]]\nkind = 'silent'\nfrom_s = 3\nto_s = 2\n", "faults.toml:4:8: fault[0].to_s"},
      {"[[fault]]\nkind = 'reset'\nfrom_s = 3\nto_s = 4\n", "fault[0].to_s"},
      {"[[fault]]\nkind = 'silent'\nfrom_s = 3\nto_s = 4\nvalue = 1\n", "fault[0].value"},
      {"fault = 3\n", "faults.toml:1:9: fault"},
      {"[camera]\n", "camera"},
      {"[[fault]\n", "faults.toml:1"},
  };
  const WorkFolder folder;
  for (const auto& [script, place] : cases) {
    folder.write("faults.toml", script);
    const Answer answer = folder.mdat("run missions/test.toml --sensor lcs-wire --camera-faults faults.toml");
    EXPECT_EQ(answer.exit_code, 2) << script;
    EXPECT_NE(answer.err.find(place), std::string::npos) << answer.err;
  }
  EXPECT_NE(folder.mdat("run missions/test.toml --camera-faults faults.toml").err.find("--sensor lcs-wire"), std::string::npos);
  EXPECT_NE(folder.mdat("run missions/test.toml --sensor lcs-wire --camera-faults none.toml").err.find("none.toml"), std::string::npos);
}

}  // namespace
}  // namespace lasso::ft
