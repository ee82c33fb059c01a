#include "fsw/mode/modes.hpp"

#include <set>
#include <string>
#include <utility>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using M = TrackingMode;
using E = ModeEvent;

const std::set<E> kPoseEvents = {E::kPoseValid, E::kPoseInvalid, E::kExhausted, E::kRecover};
const std::set<E> kStartEvents = {E::kCheck, E::kConfirmAnew, E::kFallBack};  // of a start that is tried
const std::set<E> kRangeEvents = {E::kNear, E::kFar};                         // of a valid pose, in the modes that they tell apart
const std::set<E> kBearingEvents = {E::kBearingKnown, E::kBearingUnknown};

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
  VERIFIES("LASSO-MOD-001~2 LASSO-MOD-175~1");
  EXPECT_EQ(reachable_from(M::kStandby).size(), mode_properties().size());
  for (const ModeProperties& row : mode_properties()) EXPECT_EQ(reachable_from(row.mode).count(M::kStandby), 1u) << row.name;
}

TEST(Modes, EveryModeHasAWayOut) {
  VERIFIES("LASSO-MOD-001~2 LASSO-MOD-175~1");
  for (const ModeProperties& mode : mode_properties()) {
    bool leaves = false;
    for (const ModeTransition& row : mode_transitions()) leaves = leaves || (row.from == mode.mode && row.to != mode.mode);
    EXPECT_TRUE(leaves) << mode.name;
  }
}

// From each mode tracking can be reached by commands and scans, and by scans alone where the mode scans.
TEST(Modes, EveryModeLeadsToTracking) {
  VERIFIES("LASSO-MOD-001~2");
  for (const ModeProperties& row : mode_properties()) EXPECT_EQ(reachable_from(row.mode).count(M::kTracking), 1u) << row.name;
}

// A row can be taken if its mode is reached and its event can happen there: what scans give in the modes that make them, commands anywhere.
TEST(Modes, NoTransitionIsUnreachable) {
  VERIFIES("LASSO-MOD-001~2 LASSO-MOD-175~1");
  const std::set<M> reached = reachable_from(M::kStandby);
  for (const ModeTransition& row : mode_transitions()) {
    const ModeProperties& from = properties(row.from);
    const std::set<E>& scans = from.full_field ? kBearingEvents : kPoseEvents;
    const bool commanded = mode_events()[static_cast<std::size_t>(row.event)].commanded;
    const bool of_start = from.tries_start && kStartEvents.count(row.event) != 0;
    const bool by_range = !from.full_field && kRangeEvents.count(row.event) != 0;
    EXPECT_TRUE(commanded || (from.scans && (by_range || of_start || scans.count(row.event) != 0))) << from.name << ": " << row.meaning;
    EXPECT_EQ(reached.count(row.from), 1u) << from.name;
    EXPECT_STRNE(row.meaning, "");
  }
}

TEST(Modes, EachModeAnswersEveryResultOfItsScans) {
  VERIFIES("LASSO-MOD-001~2");
  std::set<std::pair<M, E>> rows;
  for (const ModeTransition& row : mode_transitions()) {
    EXPECT_TRUE(rows.insert({row.from, row.event}).second) << "two rows for one event: " << row.meaning;
  }
  for (const ModeProperties& mode : mode_properties()) {
    for (const E event : kPoseEvents) EXPECT_EQ(rows.count({mode.mode, event}) != 0, mode.scans && !mode.full_field) << mode.name;
    for (const E event : kBearingEvents) EXPECT_EQ(rows.count({mode.mode, event}) != 0, mode.scans && mode.full_field) << mode.name;
    EXPECT_EQ(rows.count({mode.mode, E::kStop}) != 0, mode.mode != M::kStandby) << mode.name;
    const bool safe = mode.mode == M::kSafe;
    EXPECT_EQ(rows.count({mode.mode, E::kMakeSafe}) != 0, !safe) << mode.name;
    EXPECT_EQ(rows.count({mode.mode, E::kSeek}) != 0, mode.mode != M::kBearing && !safe) << mode.name;
    EXPECT_EQ(rows.count({mode.mode, E::kStart}) != 0, !safe) << mode.name;
    EXPECT_EQ(rows.count({mode.mode, E::kSearch}) != 0, mode.mode != M::kSearching && !safe) << mode.name;
  }
}

TEST(Modes, FollowTheStoryOfATrack) {
  VERIFIES("LASSO-MOD-002~2");
  EXPECT_EQ(next_mode(M::kStandby, E::kStart), M::kStarting);
  EXPECT_EQ(next_mode(M::kStarting, E::kPoseInvalid), M::kStarting);
  EXPECT_EQ(next_mode(M::kStarting, E::kPoseValid), M::kTracking);
  EXPECT_EQ(next_mode(M::kTracking, E::kPoseInvalid), M::kCoasting);
  EXPECT_EQ(next_mode(M::kCoasting, E::kPoseInvalid), M::kCoasting);
  EXPECT_EQ(next_mode(M::kCoasting, E::kPoseValid), M::kTracking);
  EXPECT_EQ(next_mode(M::kCoasting, E::kExhausted), M::kLost);
  EXPECT_EQ(next_mode(M::kLost, E::kStart), M::kStarting);
}

TEST(Modes, FollowTheStoryOfARecovery) {
  VERIFIES("LASSO-MOD-138~1");
  EXPECT_EQ(next_mode(M::kCoasting, E::kRecover), M::kReacquiring);
  EXPECT_EQ(next_mode(M::kReacquiring, E::kPoseValid), M::kTracking);
  EXPECT_EQ(next_mode(M::kReacquiring, E::kRecover), M::kBearing);
  EXPECT_EQ(next_mode(M::kBearing, E::kBearingKnown), M::kBearing);
  EXPECT_EQ(next_mode(M::kBearing, E::kStart), M::kStarting);
  EXPECT_EQ(next_mode(M::kStarting, E::kRecover), M::kBearing);
}

TEST(Modes, FollowTheStoryOfACheckedStart) {
  VERIFIES("LASSO-MOD-188~2");
  EXPECT_EQ(next_mode(M::kStarting, E::kCheck), M::kVerifying);
  EXPECT_EQ(next_mode(M::kVerifying, E::kPoseInvalid), M::kVerifying);
  EXPECT_EQ(next_mode(M::kVerifying, E::kPoseValid), M::kTracking);
  EXPECT_EQ(next_mode(M::kVerifying, E::kConfirmAnew), M::kStarting);
  for (const ModeProperties& mode : mode_properties())
    EXPECT_EQ(next_mode(mode.mode, E::kCheck) == M::kVerifying, mode.tries_start) << mode.name;
}

// Commands, faults and the end of its frames lead out of a start as if it were not checked.
TEST(Modes, AStartIsLeftTheSameWayWhetherItIsCheckedOrNot) {
  VERIFIES("LASSO-MOD-188~2");
  const std::set<E> between = {E::kPoseInvalid, E::kCheck, E::kConfirmAnew};  // the start goes on
  for (const ModeEventProperties& event : mode_events()) {
    if (between.count(event.event) != 0) continue;
    ASSERT_EQ(has_transition(M::kVerifying, event.event), has_transition(M::kStarting, event.event)) << event.name;
    if (has_transition(M::kStarting, event.event)) {
      EXPECT_EQ(next_mode(M::kVerifying, event.event), next_mode(M::kStarting, event.event)) << event.name;
    }
  }
}

TEST(Modes, FollowTheStoryOfASearch) {
  VERIFIES("LASSO-MOD-142~2");
  EXPECT_EQ(next_mode(M::kBearing, E::kSearch), M::kSearching);
  EXPECT_EQ(next_mode(M::kSearching, E::kPoseInvalid), M::kSearching);
  EXPECT_EQ(next_mode(M::kSearching, E::kPoseValid), M::kStarting);
  EXPECT_EQ(next_mode(M::kSearching, E::kRecover), M::kBearing);
  EXPECT_EQ(next_mode(M::kSearching, E::kExhausted), M::kLost);
}

TEST(Modes, FollowTheStoryOfAnApproachAndBack) {
  VERIFIES("LASSO-MOD-164~2");
  EXPECT_EQ(next_mode(M::kTracking, E::kNear), M::kShortRange);
  EXPECT_EQ(next_mode(M::kShortRange, E::kPoseValid), M::kShortRange);
  EXPECT_EQ(next_mode(M::kShortRange, E::kPoseInvalid), M::kShortRange);
  EXPECT_EQ(next_mode(M::kShortRange, E::kRecover), M::kReacquiring);
  EXPECT_EQ(next_mode(M::kShortRange, E::kFar), M::kTracking);
  EXPECT_TRUE(properties(M::kShortRange).by_parts);
  EXPECT_FALSE(properties(M::kTracking).by_parts);
}

TEST(Modes, SafeIsReachedFromEverywhereAndLeftByCommandAlone) {
  VERIFIES("LASSO-HLT-002~1");
  for (const ModeProperties& mode : mode_properties()) EXPECT_EQ(next_mode(mode.mode, E::kMakeSafe), M::kSafe) << mode.name;
  for (const ModeEventProperties& event : mode_events()) {
    EXPECT_EQ(next_mode(M::kSafe, event.event), event.event == E::kStop ? M::kStandby : M::kSafe) << event.name;
  }
  EXPECT_FALSE(properties(M::kSafe).scans);
  EXPECT_FALSE(properties(M::kSafe).awaits_start);
  EXPECT_TRUE(properties(M::kSafe).says_lost);
}

TEST(Modes, IgnoreWhatTheTableDoesNotKnow) {
  VERIFIES("LASSO-MOD-001~2");
  EXPECT_EQ(next_mode(M::kStandby, E::kPoseValid), M::kStandby);
  EXPECT_EQ(next_mode(M::kLost, E::kPoseValid), M::kLost);
  EXPECT_FALSE(has_transition(M::kStandby, E::kPoseValid));
  EXPECT_TRUE(has_transition(M::kStandby, E::kSeek));
}

TEST(Modes, AreCommandedByTheirEvents) {
  VERIFIES("LASSO-MOD-136~4");
  for (const ModeProperties& mode : mode_properties()) {
    E event = E::kPoseValid;
    if (!command_event(mode.mode, event)) {
      EXPECT_EQ(event, E::kPoseValid) << "untouched";
      continue;
    }
    EXPECT_TRUE(mode_events()[static_cast<std::size_t>(event)].commanded) << mode.name;
    for (const ModeTransition& row : mode_transitions()) {
      if (row.event == event) {
        EXPECT_EQ(row.to, mode.mode) << row.meaning;
      }
    }
  }
  E event = E::kStart;
  EXPECT_TRUE(command_event(M::kStandby, event));
  EXPECT_TRUE(command_event(M::kBearing, event));
  EXPECT_TRUE(command_event(M::kReacquiring, event));
  EXPECT_TRUE(command_event(M::kSearching, event));
  EXPECT_TRUE(command_event(M::kTracking, event));
  EXPECT_TRUE(command_event(M::kShortRange, event));
  EXPECT_TRUE(command_event(M::kSafe, event));
  for (const M mode : {M::kStarting, M::kCoasting, M::kLost, M::kVerifying}) EXPECT_FALSE(command_event(mode, event)) << to_string(mode);
}

TEST(Modes, PropertiesLieAtTheirModesPlace) {
  VERIFIES("LASSO-MOD-001~2");
  for (std::size_t i = 0; i < mode_properties().size(); ++i) EXPECT_EQ(static_cast<std::size_t>(mode_properties()[i].mode), i);
  for (std::size_t i = 0; i < mode_events().size(); ++i) EXPECT_EQ(static_cast<std::size_t>(mode_events()[i].event), i);
  EXPECT_EQ(std::string(to_string(M::kCoasting)), "coasting");
  EXPECT_EQ(std::string(to_string(E::kRecover)), "recover");
  EXPECT_EQ(std::string(to_string(ModeRefusal::kNotFromHere)), "not_from_here");
  EXPECT_EQ(std::string(to_string(static_cast<ModeRefusal>(77))), "unknown");
  EXPECT_TRUE(properties(M::kStarting).wide_start);
  EXPECT_FALSE(properties(M::kCoasting).wide_start);
  EXPECT_FALSE(properties(M::kLost).scans);
}

}  // namespace
}  // namespace lasso
