#include "mdat/benchmark/run_set.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "mdat/benchmark/score.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/replay/replay.hpp"
#include "ut/mdat/benchmark/folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::small_set;

// Of the same files by replay itself.
std::vector<ReplayedScan> replayed(const std::filesystem::path& body, bool wide) {
  ReplayOptions options;
  options.scans = body / kScansFolder;
  options.initial = body / kStartsFile;
  options.wide = wide;
  ReplayInput input = read_replay_input(options);
  const CompiledMission mission = compile_mission(body / kMissionFile);
  const LoadedImage image("test", image_bytes(mission, mission.source.parameters));
  settle_times(options, image.mission().parameters.duration_s, input);
  return replay(image.mission(), options, input);
}

bool is_same(const ProgramPose& row, const ReplayedScan& scan) {
  const Registration& found = scan.registration;
  return row.body == "body_52" && row.scan == scan.scan && row.valid == found.valid() && row.covariance == found.covariance &&
         row.T_sensor_target.p == found.T_sensor_target.p && row.T_sensor_target.q.coeffs() == found.T_sensor_target.q.coeffs();
}

// From starts so rough that replay finds other poses without --wide.
TEST(RunSet, PosesAreThoseOfReplay) {
  VERIFIES("LASSO-GND-124~1");
  const test::PassingFolder folder;
  make_set({52, 1, 8, std::nullopt, 20}, folder / "set", true);
  const ProgramPoses poses = run_set(folder / "set", true);
  const std::vector<ReplayedScan> wide = replayed(folder / "set/body_52", true), near = replayed(folder / "set/body_52", false);
  ASSERT_EQ(poses.rows.size(), 8u);
  ASSERT_EQ(wide.size(), 8u);
  EXPECT_TRUE(poses.covariances);
  int others = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_TRUE(is_same(poses.rows[i], wide[i])) << wide[i].scan;
    EXPECT_GT(poses.rows[i].time_s.value_or(0), 0);
    others += is_same(poses.rows[i], near[i]) ? 0 : 1;
  }
  EXPECT_GT(others, 0);
}

TEST(RunSet, WhatItFindsIsRightOnAnEasyBody) {
  VERIFIES("LASSO-GND-124~1");
  const Score found = score(small_set().set, run_set(small_set().path(), true));
  EXPECT_EQ(found.counts.scans, 2u);
  EXPECT_EQ(found.counts.wrong, 0u);
  EXPECT_GT(found.counts.determined, 0u);
  EXPECT_EQ(found.counts.right, found.counts.determined);
}

TEST(RunSet, AChangedSetIsNotRun) {
  VERIFIES("LASSO-GND-121~1");
  const test::PassingFolder folder;
  std::filesystem::copy(small_set().path(), folder / "set", std::filesystem::copy_options::recursive);
  std::ofstream(folder / "set/body_52/mission.toml", std::ios::app) << "# tuned\n";
  EXPECT_NE(test::error_of([&] { run_set(folder / "set", true); }).find("mission.toml: was changed"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
