#include "fsw/exec/component.hpp"

#include <algorithm>
#include <cstdio>

#include "fsw/sense/planner.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/link/pose_packet.hpp"

namespace lasso {
namespace {

using test::ComponentScene;
using test::Report;

constexpr auto kTracking = static_cast<std::uint8_t>(TrackingMode::kTracking);
constexpr auto kCoasting = static_cast<std::uint8_t>(TrackingMode::kCoasting);
constexpr auto kLost = static_cast<std::uint8_t>(TrackingMode::kLost);

MissionParameters started_parameters() {
  Vec6 off;
  off << 0.02, -0.03, 0.01, 0.01, 0.02, -0.02;
  return test::box_parameters(test::default_scene(), off);
}

std::uint8_t reason(PoseReason reason) { return static_cast<std::uint8_t>(reason); }

// Runs frames up to the one whose boundary reports scan `scan_id`, and gives that report.
PoseTelemetry report_of(ComponentScene& scene, std::uint32_t scan_id) {
  for (std::uint32_t frame = 0; frame < 100; ++frame) {
    for (const Report& report : scene.run_frame()) {
      if (report.pose.scan_id == scan_id) return report.pose;
    }
  }
  ADD_FAILURE() << "scan " << scan_id << " was never reported";
  return {};
}

TEST(Component, ReportsEachScanTwoBoundariesLater) {
  VERIFIES("LASSO-EXE-002~1 LASSO-SYS-023~1 LASSO-SYS-027~1 LASSO-MOD-141~2 LASSO-LNK-025~2");
  ComponentScene scene(started_parameters());
  scene.begin();
  for (std::uint32_t frame = 0; frame < 40; ++frame) {
    const auto reports = scene.run_frame();
    ASSERT_EQ(reports.size(), frame < 2 ? 0u : 1u);
    if (reports.empty()) continue;
    const PoseTelemetry& t = reports[0].pose;
    EXPECT_EQ(t.scan_id, frame - 2);
    EXPECT_EQ(reports[0].header.message_count, frame - 1) << "behind that of health";
    EXPECT_EQ(reports[0].header.t_us, frame * 200000);
    EXPECT_EQ(t.t_publication_us, frame * 200000);
    EXPECT_EQ(t.t_measurement_us, (frame - 2) * 200000 + 90000);
    EXPECT_EQ(t.age_us, 310000u);
    EXPECT_EQ(t.frames, frame + 1);
  }
}

TEST(Component, PublishesWithinFourTenthsOfASecond) {
  VERIFIES("LASSO-EXE-007~2 LASSO-NEED-003~1");
  for (const double duration_s : {0.18, 0.002}) {  // the shorter a scan, the earlier its middle
    MissionParameters p = started_parameters();
    p.duration_s = duration_s;
    ComponentScene scene(p);
    scene.begin();
    const PoseTelemetry pose = report_of(scene, 5);
    EXPECT_EQ(pose.valid, 1);
    EXPECT_LE(pose.age_us, 400000u);
    EXPECT_EQ(pose.t_publication_us - pose.t_measurement_us, pose.age_us);
  }
}

TEST(Component, TracksTheTarget) {
  VERIFIES("LASSO-EXE-005~2 LASSO-SYS-001~2 LASSO-MOD-131~1");
  ComponentScene scene(started_parameters());
  scene.begin();
  const test::BoxScene truth = test::default_scene();
  PoseTelemetry last;
  for (std::uint32_t frame = 0; frame < 40; ++frame) {
    for (const Report& report : scene.run_frame()) {
      last = report.pose;
      ASSERT_EQ(report.pose.valid, 1) << report.pose.scan_id << " reason " << int{report.pose.reason};
      EXPECT_EQ(report.pose.mode, kTracking);
      EXPECT_LT(scene.error(report.pose).head<3>().norm(), 3e-3);
      EXPECT_LT(scene.error(report.pose).tail<3>().norm(), 1e-3);
      EXPECT_EQ(report.pose.plan_points, 1024);
    }
  }
  EXPECT_EQ(last.start_source, static_cast<std::uint8_t>(InitialPoseSource::kApriori)) << "the mission's own pose";
  // In metres and radians, and per second: the filtered pose and its rates.
  PoseTelemetry filtered = last;
  std::copy_n(last.filter_q_sensor_target, 4, filtered.q_sensor_target);
  std::copy_n(last.filter_p_sensor_target_m, 3, filtered.p_sensor_target_m);
  EXPECT_LT(scene.error(filtered).head<3>().norm(), 3e-3);
  EXPECT_LT(scene.error(filtered).tail<3>().norm(), 1e-3);
  EXPECT_LT((Vec3(last.filter_omega_radps) - truth.rates.omega_radps).norm(), 5e-3);
  EXPECT_LT((Vec3(last.filter_v_mps) - truth.rates.v_mps).norm(), 2e-3);
}

TEST(Component, PlansFromThePredictionOfTheLastPublishedScan) {
  VERIFIES("LASSO-EXE-002~1");
  ComponentScene scene(started_parameters());
  scene.begin();
  for (int frame = 0; frame < 30; ++frame) scene.run_frame();
  const auto reports = scene.run_frame();
  const PoseTelemetry& t = reports.at(0).pose;
  FilterState filter;
  Pose pose;
  pose.q = Quat(t.filter_q_sensor_target[3], t.filter_q_sensor_target[0], t.filter_q_sensor_target[1], t.filter_q_sensor_target[2]);
  pose.p = Vec3(t.filter_p_sensor_target_m[0], t.filter_p_sensor_target_m[1], t.filter_p_sensor_target_m[2]);
  Twist rates;
  rates.omega_radps = Vec3(t.filter_omega_radps[0], t.filter_omega_radps[1], t.filter_omega_radps[2]);
  rates.v_mps = Vec3(t.filter_v_mps[0], t.filter_v_mps[1], t.filter_v_mps[2]);
  ScanPlan expected;
  const Mission& mission = scene.component->mission();
  const double place_sigma_m = static_cast<double>(*std::max_element(t.filter_sigma_pose + 3, t.filter_sigma_pose + 6));
  const TargetOutline outline{mission.hull, mission.center_m, place_sigma_m};
  ASSERT_EQ(plan_scan(mission.parameters, outline, propagate(pose, rates, 0.4), 30, expected), Status::kOk);
  EXPECT_EQ(scene.sensor.last_plan.scan_id, 30u);
  EXPECT_NEAR(scene.sensor.last_plan.center_x, expected.center_x, 1e-12);
  EXPECT_NEAR(scene.sensor.last_plan.half_y, expected.half_y, 1e-10);
  EXPECT_EQ(scene.sensor.last_plan.phase_turns, expected.phase_turns);
}

TEST(Component, LostScansCoastAndAreCounted) {
  VERIFIES("LASSO-EXE-005~2 LASSO-MOD-005~2 LASSO-HLT-011~1");
  ComponentScene scene(started_parameters());
  scene.sensor.lost = {10};
  scene.sensor.refused = {11};
  scene.begin();
  EXPECT_EQ(report_of(scene, 9).lost_scans, 0u);
  const PoseTelemetry lost = report_of(scene, 10);
  EXPECT_EQ(lost.reason, reason(PoseReason::kNoScan));
  EXPECT_EQ(lost.valid, 0);
  EXPECT_EQ(lost.lost_scans, 1u);
  EXPECT_EQ(lost.mode, kCoasting);
  EXPECT_EQ(lost.t_measurement_us, 2090000);
  EXPECT_LT(scene.error(lost).norm(), 1e-2);
  EXPECT_EQ(report_of(scene, 11).invalid_frames, 2u);
  const PoseTelemetry next = report_of(scene, 12);
  EXPECT_EQ(next.valid, 1);
  EXPECT_EQ(next.mode, kTracking);
  EXPECT_EQ(next.lost_scans, 2u);
}

TEST(Component, LateEstimateIsDroppedWholeAndTheTrackGoesOn) {
  VERIFIES("LASSO-EXE-003~1 LASSO-HLT-011~1");
  ComponentScene scene(started_parameters());
  scene.begin();
  for (int frame = 0; frame < 10; ++frame) scene.run_frame();
  scene.run_frame(false);                   // frame 10: the estimate of scan 9 does not get the processor
  const auto late = scene.run_frame(true);  // boundary 11: late; it ends in this frame
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(late[0].pose.scan_id, 9u);
  EXPECT_EQ(late[0].pose.reason, reason(PoseReason::kOverrun));
  EXPECT_EQ(late[0].pose.overruns, 1u);
  EXPECT_EQ(late[0].pose.valid, 0);
  EXPECT_EQ(late[0].pose.t_measurement_us, 9 * 200000 + 90000);
  EXPECT_LT(scene.error(late[0].pose).norm(), 1e-2) << "the filter's prediction";
  const auto blocked = scene.run_frame();  // scan 10 found the estimator busy
  EXPECT_EQ(blocked.at(0).pose.scan_id, 10u);
  EXPECT_EQ(blocked.at(0).pose.reason, reason(PoseReason::kOverrun));
  EXPECT_EQ(blocked.at(0).pose.overruns, 2u);
  EXPECT_EQ(blocked.at(0).pose.valid, 0);
  EXPECT_EQ(blocked.at(0).pose.t_measurement_us, 10 * 200000 + 90000);
  EXPECT_LT(scene.error(blocked.at(0).pose).norm(), 1e-2);
  const auto next = scene.run_frame();
  EXPECT_EQ(next.at(0).pose.scan_id, 11u);
  EXPECT_EQ(next.at(0).pose.valid, 1);
  EXPECT_LT(scene.error(next.at(0).pose).norm(), 5e-3);
  EXPECT_EQ(next.at(0).pose.slot_slips, 0u);
  scene.component->run_slot(scene.component->next_slot_us() + 30'000);  // later than its own 10 ms
  scene.component->run_estimation();
  scene.run_frame();
  EXPECT_EQ(scene.run_frame().at(0).pose.slot_slips, 1u);
}

TEST(Component, LostTrackStopsScanningAndSaysSo) {
  VERIFIES("LASSO-MOD-007~2 LASSO-LNK-025~2");
  MissionParameters p = started_parameters();
  p.coast_frames = 2;
  ComponentScene scene(p);
  scene.sensor.lost = {5, 6, 7};
  scene.begin();
  const PoseTelemetry last = report_of(scene, 7);
  EXPECT_EQ(last.mode, kLost);
  const int starts = scene.sensor.starts;
  for (std::uint32_t frame = 8; frame < 12; ++frame) {
    const auto told = scene.run_frame();
    ASSERT_EQ(told.size(), 1u) << "each frame says so";
    EXPECT_EQ(told[0].pose.mode, kLost);
    EXPECT_EQ(told[0].pose.valid, 0);
    EXPECT_EQ(told[0].pose.t_measurement_us, last.t_measurement_us);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(told[0].pose.p_sensor_target_m[i], last.p_sensor_target_m[i]) << "the last prediction";
  }
  const PoseTelemetry after = report_of(scene, 12);
  EXPECT_EQ(scene.sensor.starts, starts);
  EXPECT_EQ(after.mode, kLost);
  EXPECT_EQ(after.reason, reason(PoseReason::kNoTrack));
  EXPECT_EQ(after.plan_points, 0);
  EXPECT_EQ(after.age_us, 14u * 200000 - (7 * 200000 + 90000));  // the pose is that of scan 7, and grows old
}

TEST(Component, StartsAgainFromAGivenPose) {
  VERIFIES("LASSO-MOD-006~2");
  MissionParameters p = started_parameters();
  p.initial_present = 0;
  ComponentScene scene(p);
  scene.begin();
  for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(scene.run_frame().empty());
  EXPECT_EQ(scene.sensor.starts, 0);
  const test::BoxScene truth = test::default_scene();
  ASSERT_EQ(scene.component->start_tracking(truth.pose_at(900000), truth.rates, 900000), Status::kOk);
  const PoseTelemetry first = report_of(scene, 5);
  EXPECT_EQ(first.valid, 1);
  EXPECT_EQ(first.mode, kTracking);
  ASSERT_EQ(scene.component->stop_tracking(), Status::kOk);
  scene.run_frame();
  const int starts = scene.sensor.starts;
  const auto told = scene.run_frame();
  ASSERT_EQ(told.size(), 1u) << "the change of the mode";
  EXPECT_EQ(told[0].pose.mode, static_cast<std::uint8_t>(TrackingMode::kStandby));
  EXPECT_EQ(told[0].pose.valid, 0);
  for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(scene.run_frame().empty());
  EXPECT_EQ(scene.sensor.starts, starts);
}

TEST(Component, RefusesAStartThatMeansNothing) {
  VERIFIES("LASSO-MOD-008~2 LASSO-SYS-011~2");
  ComponentScene scene(started_parameters());
  EXPECT_EQ(scene.component->start_tracking(Pose{}, Twist{}, 0), Status::kBadOrder);
  EXPECT_EQ(scene.component->stop_tracking(), Status::kBadOrder);
  scene.begin();
  Pose bad;
  bad.q.w() = 0.9;
  EXPECT_EQ(scene.component->start_tracking(bad, Twist{}, 0), Status::kBadValue);
  EXPECT_EQ(report_of(scene, 3).valid, 1);  // the mission's own start stands
}

TEST(Component, NeedsAnImageThatFitsItsFrames) {
  VERIFIES("LASSO-EXE-008~2");
  ComponentScene scene(started_parameters());
  EXPECT_EQ(scene.component->begin(0), Status::kMissing);
  scene.begin();
  EXPECT_EQ(scene.component->begin(0), Status::kBadOrder);
  EXPECT_EQ(scene.load().status, Status::kBadOrder);
  MissionParameters p = started_parameters();
  p.period_s = p.duration_s;
  EXPECT_EQ(ComponentScene(p).load().status, Status::kOk) << "it just fits";
  p.period_s = p.duration_s - 1e-6;
  ComponentScene slow(p);
  EXPECT_EQ(slow.load().status, Status::kBadValue);
  EXPECT_EQ(slow.component->begin(0), Status::kMissing);
}

TEST(Component, ARefusedImageLeavesNothingToBeginWith) {
  VERIFIES("LASSO-EXE-008~2 LASSO-SYS-011~2");
  ComponentScene scene(started_parameters());
  ASSERT_EQ(scene.load().status, Status::kOk);
  test::TestImage damaged = test::make_box_image(started_parameters());
  damaged.data()[damaged.size / 2] ^= 1;
  EXPECT_EQ(scene.component->load_image(Bytes(damaged.data(), damaged.size)).status, Status::kBadCrc);
  EXPECT_EQ(scene.component->begin(0), Status::kMissing);
}

TEST(Component, ScansAtMostTheModelsRadiusFartherForARoughStart) {
  VERIFIES("LASSO-EXE-002~1");
  MissionParameters p = started_parameters();
  p.start_sigma_m = 50;
  p.fov_half_x_rad = 0.7;
  p.fov_half_y_rad = 0.7;
  ComponentScene scene(p);
  scene.begin();
  scene.run_frame();
  const Mission& mission = scene.component->mission();
  Pose start;
  start.q = Quat(p.initial_qw, p.initial_qx, p.initial_qy, p.initial_qz);
  start.p = Vec3(p.initial_x_m, p.initial_y_m, p.initial_z_m);
  ScanPlan expected;
  ASSERT_EQ(plan_scan(mission.parameters, {mission.hull, mission.center_m, mission.radius_m}, start, 0, expected), Status::kOk);
  EXPECT_NEAR(scene.sensor.last_plan.half_x, expected.half_x, 1e-12);
  EXPECT_NEAR(scene.sensor.last_plan.half_y, expected.half_y, 1e-12);
}

TEST(Component, AnEstimateIsPendingFromTheHandOverUntilItHasRun) {
  VERIFIES("LASSO-EXE-002~1");
  ComponentScene scene(started_parameters());
  scene.begin();
  scene.run_frame();
  EXPECT_FALSE(scene.component->estimation_pending());
  scene.component->run_slot(scene.component->next_slot_us());  // boundary 1: scan 0 is handed over
  EXPECT_TRUE(scene.component->estimation_pending());
  scene.component->run_estimation();
  EXPECT_FALSE(scene.component->estimation_pending());
}

TEST(Component, SequenceCountWrapsThroughTheWholeChain) {
  VERIFIES("LASSO-LNK-001~1 LASSO-HLT-007~2");
  MissionParameters p = started_parameters();
  p.start_frames = 0;  // lost from the second report on: frames without a scan are short
  ComponentScene scene(p);
  scene.sensor.refused = {0};
  scene.begin();
  std::uint16_t expected = 0;
  std::size_t poses = 0;
  for (int frame = 0; frame < 0x4003; ++frame) {
    scene.stream.clear();
    poses += scene.run_frame().size();
    ConstBytes rest(scene.stream.data(), scene.stream.size());
    while (!rest.empty()) {
      ASSERT_EQ(read_primary_header(rest).sequence_count, expected);
      expected = static_cast<std::uint16_t>((expected + 1) & kSequenceCountMask);
      rest = rest.subspan(packet_size(rest), rest.size() - packet_size(rest));
    }
  }
  EXPECT_EQ(poses, 0x4001u);
}

TEST(Component, FullQueueCountsWhatItDrops) {
  VERIFIES("LASSO-LNK-006~1 LASSO-HLT-011~1");
  ComponentScene scene(started_parameters());
  scene.begin();
  for (int slot = 0; slot < 25 * 20; ++slot) {
    scene.component->run_slot(scene.component->next_slot_us());
    scene.component->run_estimation();
  }
  scene.run_frame();  // empties the queue
  const auto reports = scene.run_frame();
  EXPECT_EQ(reports.at(0).pose.dropped_packets, 24u - kTelemetryQueueBytes / test::pose_packet_bytes());
}

TEST(Component, StaysWithinItsMemory) {
  VERIFIES("LASSO-EXE-009~1");
  std::printf("static memory of the component, image apart: %zu bytes\n", sizeof(Component));
  EXPECT_LE(sizeof(Component), 2u << 20);
}

MissionParameters aiming_parameters() {
  MissionParameters p = started_parameters();
  p.aimed_share = 0.3;
  p.silhouette_band_m = 0.01;
  return p;
}

TEST(Component, LooksWhereTheLastPublishedEstimateSays) {
  VERIFIES("LASSO-SNS-014~2 LASSO-SNS-016~1");
  ComponentScene scene(aiming_parameters());
  scene.begin();
  scene.run_frame();
  EXPECT_TRUE(scene.sensor.last_plan.aimed.empty());  // nothing is known yet
  for (int frame = 1; frame < 20; ++frame) scene.run_frame();
  EXPECT_EQ(scene.sensor.last_plan.aimed.size(), 306u);
  EXPECT_EQ(scene.sensor.last_plan.points, 1024);
  EXPECT_EQ(report_of(scene, 19).plan_points, 1024);
  EXPECT_EQ(report_of(scene, 20).valid, 1);
}

TEST(Component, ALateEstimateOrANewTrackAimsNothing) {
  VERIFIES("LASSO-SNS-016~1");
  ComponentScene scene(aiming_parameters());
  scene.begin();
  for (int frame = 0; frame < 20; ++frame) scene.run_frame();
  ASSERT_FALSE(scene.sensor.last_plan.aimed.empty());
  scene.run_frame(false);
  scene.run_frame(true);  // its boundary found no estimate
  EXPECT_TRUE(scene.sensor.last_plan.aimed.empty());
  for (int frame = 0; frame < 10; ++frame) scene.run_frame();
  ASSERT_FALSE(scene.sensor.last_plan.aimed.empty());
  ASSERT_EQ(scene.component->start_tracking(test::default_scene().at_zero, test::default_scene().rates, 0), Status::kOk);
  scene.run_frame();
  EXPECT_TRUE(scene.sensor.last_plan.aimed.empty());
}

}  // namespace
}  // namespace lasso
