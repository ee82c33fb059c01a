#include "mdat/missiondb/old_kinds.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class OldKindsTest : public ::testing::Test {
 protected:
  OldKindsTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [2, 1, 1]\n"); }

  // What is said of a mission with this scenario; its first line is line 8 of the file.
  std::string said_of(const std::string& scenario) {
    const std::string head = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";
    return mission_error_of([&] { static_cast<void>(load_mission(folder_.write("m.toml", head + "[scenario.s]\n" + scenario))); });
  }
  void expect_said(const std::string& scenario, const std::string& expected) {
    const std::string text = said_of(scenario), line = "m.toml:8:8: scenario.s.kind: " + expected;
    EXPECT_TRUE(text.size() >= line.size() && text.compare(text.size() - line.size(), line.size(), line) == 0) << text;
  }

  Folder folder_;
};

TEST_F(OldKindsTest, SayWhatIsWrittenToday) {
  VERIFIES("LASSO-SCN-030~1");
  const std::string none = ": scenarios have no kinds: ";
  expect_said("kind = 'spin'\nranges_m = [5]\n", "'spin'" + none + "delete this line");
  expect_said("kind = 'scene'\n", "'scene'" + none + "delete this line");
  expect_said("kind = 'pass'\nranges_m = [6, 5]\ntimes_s = [0, 20]\n", "'pass'" + none + "delete this line");
  expect_said("kind = 'approach'\nranges_m = [6, 5]\ntimes_s = [0, 20]\n",
              "'approach'" + none + "write instead of this line: autonomous = true");
  expect_said("kind = 'approach'\nranges_m = [5]\n", "'approach'" + none + "write instead of this line: autonomous = true; times_s = [0]");
  expect_said("kind = 'paper'\nranges_m = [5]\n",
              "'paper'" + none + "write instead of this line: variants = true; step_deg = 1; override.estimation.deskew = false");
  expect_said("kind = 'paper'\nranges_m = [5]\nstep_deg = 2\noverride.estimation.deskew = true\n",
              "'paper'" + none + "write instead of this line: variants = true");
  expect_said("kind = 'flyby'\nranges_m = [5]\n", "'flyby'" + none + "delete this line");
}

TEST_F(OldKindsTest, SayWhatHadNoEffectAndWouldHaveOne) {
  VERIFIES("LASSO-SCN-030~1");
  expect_said("kind = 'spin'\nranges_m = [5]\nstep_deg = 1\ntimes_s = [0]\n",
              "'spin': scenarios have no kinds: delete this line; and delete step_deg, times_s, which had no effect");
}

// What is written instead is read, and says the same.
TEST_F(OldKindsTest, WhatTheySayIsReadToday) {
  VERIFIES("LASSO-SCN-030~1");
  EXPECT_EQ(said_of("ranges_m = [5]\n"), "");
  EXPECT_EQ(said_of("variants = true\nstep_deg = 1\noverride.estimation.deskew = false\nranges_m = [5]\n"), "");
  EXPECT_EQ(said_of("autonomous = true\ntimes_s = [0]\nranges_m = [5]\n"), "");
}

}  // namespace
}  // namespace lasso::mdat
