// The whole component close to a target that it scans part by part.
#include <set>

#include "ut/exec/component_operator.hpp"
#include "ut/support/box_parts.hpp"

namespace lasso {
namespace {

using test::ComponentScene;
using test::Report;
using M = TrackingMode;

// Drifting away from 2.5 m: close until 2.7 m, for 20 frames.
test::BoxScene leaving_scene() {
  test::BoxScene scene = test::default_scene();
  scene.rates.v_mps = Vec3(0.004, -0.003, 0.05);
  return scene;
}

MissionParameters parameters() {
  MissionParameters p = test::box_parameters(leaving_scene());
  p.short_range_enter_m = 2.6;
  p.short_range_leave_m = 2.7;
  return p;
}

test::TestImage image_with_parts(const std::vector<test::BoxPart>& parts) {
  static const test::BoxTables whole = test::make_box_tables(test::BoxModel{});
  return test::make_image(parameters(), test::with_parts(whole, parts, parameters()));
}

std::vector<PoseTelemetry> run(ComponentScene& scene, int frames) {
  std::vector<PoseTelemetry> reports;
  for (int i = 0; i < frames; ++i) {
    for (const Report& report : scene.run_frame()) reports.push_back(report.pose);
  }
  return reports;
}

TEST(ComponentParts, ScansThePartsInTurnAndHandsOverBothWays) {
  VERIFIES("LASSO-MOD-161~3 LASSO-MOD-162~1 LASSO-MOD-164~2 LASSO-MOD-171~3");
  ComponentScene scene(leaving_scene(), image_with_parts(test::two_halves()));
  scene.begin();
  ASSERT_EQ(scene.component->parts().size(), 2U);
  std::vector<M> modes;
  std::set<int> parts;
  double wholes = 0;
  for (const PoseTelemetry& t : run(scene, 40)) {
    EXPECT_EQ(t.valid, 1) << t.scan_id << " " << to_string(static_cast<PoseReason>(t.reason));
    EXPECT_EQ(t.inconsistent_parts, 0U);
    EXPECT_EQ(t.parts_resting, 0);
    const Vec6 e = scene.error(t);
    EXPECT_LT(e.head<3>().norm(), 5e-3) << t.scan_id;
    EXPECT_LT(e.tail<3>().norm(), 3e-3) << t.scan_id;
    const M mode = static_cast<M>(t.mode);
    if (modes.empty() || modes.back() != mode) modes.push_back(mode);
    if (mode == M::kShortRange) parts.insert(t.part);
    if (t.part == 0) wholes += t.plan_half_extents[0];
  }
  EXPECT_EQ(modes, (std::vector<M>{M::kTracking, M::kShortRange, M::kTracking}));
  EXPECT_EQ(parts, (std::set<int>{0, 1, 2})) << "0: scans that were on their way";
  EXPECT_GT(wholes, 0);
}

TEST(ComponentParts, APartWhoseScansOutlastThePeriodIsRefused) {
  VERIFIES("LASSO-EXE-008~2");
  MissionParameters p = parameters();
  p.duration_s = 2 * p.period_s;
  const test::BoxTables whole = test::make_box_tables(test::BoxModel{});
  ComponentScene scene(leaving_scene(), test::make_image(parameters(), test::with_parts(whole, test::two_halves(), p)));
  EXPECT_EQ(scene.load().status, Status::kBadValue);
  EXPECT_EQ(scene.component->begin(0), Status::kMissing);
}

TEST(ComponentParts, AModeThatIsLeftWhereItIsEnteredIsRefused) {
  VERIFIES("LASSO-MOD-171~3");
  MissionParameters p = parameters();
  p.short_range_leave_m = p.short_range_enter_m;
  ComponentScene scene(leaving_scene(), test::make_box_image(p));
  const LoadFailure failure = scene.load();
  EXPECT_EQ(failure.status, Status::kBadValue);
  EXPECT_STREQ(failure.what, "short_range.leave_m is not above short_range.enter_m");
}

TEST(ComponentParts, AScanOfAPartIsLaidOverThePart) {
  VERIFIES("LASSO-MOD-161~3");
  ComponentScene scene(leaving_scene(), image_with_parts(test::two_halves()));
  scene.begin();
  double whole = 0;
  int of_parts = 0;
  for (const PoseTelemetry& t : run(scene, 12)) {
    const double area = t.plan_half_extents[0] * t.plan_half_extents[1];
    if (t.part == 0) whole = area;
    if (t.part == 0) continue;
    ++of_parts;
    EXPECT_LT(area, 0.8 * whole);
  }
  EXPECT_GT(whole, 0);
  EXPECT_GE(of_parts, 6);
}

TEST(ComponentParts, APartThatIsNotWhereItsModelSaysIsDroppedAndTold) {
  VERIFIES("LASSO-MOD-162~1");
  std::vector<test::BoxPart> parts = test::two_halves();
  parts.push_back(test::half_box(true));
  parts[2].T_target_part.p += Vec3(0, 0.006, 0.004);
  ComponentScene scene(leaving_scene(), image_with_parts(parts));
  scene.begin();
  std::uint32_t inconsistent = 0;
  for (const PoseTelemetry& t : run(scene, 22)) {
    if (t.inconsistent_part != 0) {
      ++inconsistent;
      EXPECT_EQ(t.inconsistent_part, 3);
      EXPECT_EQ(t.parts_resting, 4);
      EXPECT_GT(t.inconsistency_sigmas, 6);
    }
    EXPECT_EQ(t.inconsistent_parts, inconsistent);
    if (t.valid == 0) continue;
    EXPECT_LT(scene.error(t).tail<3>().norm(), 3e-3) << t.scan_id;
  }
  EXPECT_GE(inconsistent, 1U);
  std::uint32_t events = 0;
  for (const test::Stream& event : test::events_of(test::packets_of(scene.stream))) {
    if (event[1] != static_cast<std::uint8_t>(EventId::kPartInconsistent)) continue;
    ++events;
    EXPECT_EQ(event[2], 3) << "the part";
  }
  EXPECT_EQ(events, inconsistent);
}

// In both directions the track goes on without a gap, and stays where it was commanded whatever the range.
TEST(ComponentParts, ShortRangeAndTrackingAreCommandedBothWays) {
  VERIFIES("LASSO-MOD-136~4 LASSO-MOD-137~1 LASSO-MOD-173~2");
  ComponentScene scene(leaving_scene(), image_with_parts(test::two_halves()));
  scene.begin();
  run(scene, 8);
  ASSERT_EQ(scene.component->command_mode(M::kTracking), ModeRefusal::kNone);  // at less than enter_m
  std::vector<PoseTelemetry> reports = run(scene, 6);
  EXPECT_EQ(reports.size(), 6U) << "none is missing";
  EXPECT_NE(reports[1].part, 0) << "on its way when the command came";
  EXPECT_EQ(reports[2].part, 0) << "begun after it";
  EXPECT_EQ(static_cast<M>(reports.back().mode), M::kTracking);
  EXPECT_EQ(reports.back().part, 0);
  run(scene, 30);  // beyond leave_m
  ASSERT_EQ(scene.component->command_mode(M::kShortRange), ModeRefusal::kNone);
  std::set<int> parts;
  for (const PoseTelemetry& t : run(scene, 10)) {
    reports.push_back(t);
    parts.insert(t.part);
  }
  EXPECT_EQ(static_cast<M>(reports.back().mode), M::kShortRange);
  EXPECT_EQ(parts, (std::set<int>{0, 1, 2}));
  EXPECT_EQ(scene.component->command_mode(M::kShortRange), ModeRefusal::kNone) << "it is there already";
  for (const PoseTelemetry& t : reports) EXPECT_EQ(t.valid, 1) << t.scan_id << " " << to_string(static_cast<PoseReason>(t.reason));
  EXPECT_EQ(reports.back().changes, 0);
}

TEST(ComponentParts, ACommandEndsTheScansOfParts) {
  VERIFIES("LASSO-MOD-136~4");
  ComponentScene scene(leaving_scene(), image_with_parts(test::two_halves()));
  scene.begin();
  run(scene, 8);
  ASSERT_EQ(scene.component->stop_tracking(), Status::kOk);
  run(scene, 3);
  EXPECT_TRUE(run(scene, 3).empty());
  ASSERT_EQ(scene.component->command_mode(M::kReacquiring), ModeRefusal::kNotFromHere);
}

TEST(ComponentParts, AnEstimateThatIsLateAimsAtTheWhole) {
  VERIFIES("LASSO-EXE-003~1");
  ComponentScene scene(leaving_scene(), image_with_parts(test::two_halves()));
  scene.begin();
  run(scene, 8);
  scene.run_frame(false);
  std::vector<PoseTelemetry> reports = run(scene, 6);
  EXPECT_EQ(static_cast<PoseReason>(reports[0].reason), PoseReason::kOverrun);
  EXPECT_NE(reports[0].part, 0) << "the scan that is lost looked at a part";
  bool whole = false;
  for (const PoseTelemetry& t : reports) whole = whole || (t.part == 0 && static_cast<PoseReason>(t.reason) == PoseReason::kValid);
  EXPECT_TRUE(whole);
  EXPECT_EQ(static_cast<M>(reports.back().mode), M::kShortRange);
}

}  // namespace
}  // namespace lasso
