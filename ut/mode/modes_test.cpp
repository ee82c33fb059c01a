#include "fsw/mode/modes.hpp"

#include <set>
#include <string>
#include <utility>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using M = TrackingMode;
using E = ModeEvent;

std::set<M> reachable_from(M start) {
  std::set<M> seen{start};
  for (std::size_t round = 0; round < mode_transitions().size(); ++round) {
    for (const ModeTransition& row : mode_transitions()) {
      if (seen.count(row.from) != 0) seen.insert(row.to);
    }
  }
  return seen;
}

TEST(Modes, EveryModeIsReachedAndLeadsBackToStandby) {
  VERIFIES("LASSO-MOD-001~1");
  EXPECT_EQ(reachable_from(M::kStandby).size(), mode_properties().size());
  for (const ModeProperties& row : mode_properties()) EXPECT_EQ(reachable_from(row.mode).count(M::kStandby), 1u) << row.name;
}

TEST(Modes, EveryModeHasAWayOut) {
  VERIFIES("LASSO-MOD-001~1");
  for (const ModeProperties& mode : mode_properties()) {
    bool leaves = false;
    for (const ModeTransition& row : mode_transitions()) leaves = leaves || (row.from == mode.mode && row.to != mode.mode);
    EXPECT_TRUE(leaves) << mode.name;
  }
}

TEST(Modes, ScanningModesAnswerEveryResultOfAScan) {
  VERIFIES("LASSO-MOD-001~1");
  std::set<std::pair<M, E>> rows;
  for (const ModeTransition& row : mode_transitions()) {
    EXPECT_TRUE(rows.insert({row.from, row.event}).second) << "two rows for one event: " << row.meaning;
  }
  for (const ModeProperties& mode : mode_properties()) {
    for (const E event : {E::kPoseValid, E::kPoseInvalid, E::kExhausted}) {
      EXPECT_EQ(rows.count({mode.mode, event}) != 0, mode.scans) << mode.name;
    }
  }
}

TEST(Modes, FollowTheStoryOfATrack) {
  VERIFIES("LASSO-MOD-002~1");
  EXPECT_EQ(next_mode(M::kStandby, E::kStart), M::kStarting);
  EXPECT_EQ(next_mode(M::kStarting, E::kPoseInvalid), M::kStarting);
  EXPECT_EQ(next_mode(M::kStarting, E::kPoseValid), M::kTracking);
  EXPECT_EQ(next_mode(M::kTracking, E::kPoseInvalid), M::kCoasting);
  EXPECT_EQ(next_mode(M::kCoasting, E::kPoseInvalid), M::kCoasting);
  EXPECT_EQ(next_mode(M::kCoasting, E::kPoseValid), M::kTracking);
  EXPECT_EQ(next_mode(M::kCoasting, E::kExhausted), M::kLost);
  EXPECT_EQ(next_mode(M::kLost, E::kStart), M::kStarting);
}

TEST(Modes, IgnoreWhatTheTableDoesNotKnow) {
  VERIFIES("LASSO-MOD-001~1");
  EXPECT_EQ(next_mode(M::kStandby, E::kPoseValid), M::kStandby);
  EXPECT_EQ(next_mode(M::kLost, E::kPoseValid), M::kLost);
}

TEST(Modes, PropertiesLieAtTheirModesPlace) {
  VERIFIES("LASSO-MOD-001~1");
  for (std::size_t i = 0; i < mode_properties().size(); ++i) EXPECT_EQ(static_cast<std::size_t>(mode_properties()[i].mode), i);
  EXPECT_EQ(std::string(to_string(M::kCoasting)), "coasting");
  EXPECT_TRUE(properties(M::kStarting).wide_start);
  EXPECT_FALSE(properties(M::kCoasting).wide_start);
  EXPECT_FALSE(properties(M::kLost).scans);
}

}  // namespace
}  // namespace lasso
