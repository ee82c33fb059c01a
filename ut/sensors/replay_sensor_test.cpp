#include "hal_sim/replay_sensor.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

constexpr TimeUs kThenUs = 1'000'000, kNowUs = 7'000'000;

ScanPlan plan_with_id(std::uint32_t scan_id = 5) {
  ScanPlan plan;
  plan.scan_id = scan_id;
  plan.points = 16;
  plan.cycles_a = 5;
  plan.cycles_b = 3;
  plan.duration_us = 15'000;
  plan.phase_turns = 0.25;
  return plan;
}

// Of 16 samples, a millisecond apart, at `range_m` and farther.
SensorScan scan_of(float range_m, Status end = Status::kOk, std::uint8_t sensor = 0) {
  SensorScan scan;
  scan.sensor = sensor;
  scan.plan = plan_with_id();
  scan.t_start_us = kThenUs;
  scan.end = end;
  for (int i = 0; i < 16; ++i) {
    RangeSample sample;
    sample.state = RayState::kHit;
    sample.range_m = range_m + 0.01F * static_cast<float>(i);
    sample.t_us = kThenUs + 1'000 * i;
    scan.samples.push_back(sample);
  }
  return scan;
}

struct Played {
  std::vector<RangeSample> samples;
  SensorPoll last;
};
Played play(Sensor& sensor, TimeUs until_us) {
  Played played;
  RangeSample out[7];
  for (played.last.count = 7; played.last.count == 7 && !played.last.complete && played.last.status == Status::kOk;) {
    played.last = sensor.poll(until_us, Span<RangeSample>(out));
    played.samples.insert(played.samples.end(), out, out + played.last.count);
  }
  return played;
}

TEST(ReplaySensor, PlaysItsScansInTurnAtTheTimesAfterTheStart) {
  VERIFIES("LASSO-SNS-031~1");
  const SensorRecording recording{scan_of(2), scan_of(9, Status::kOk, 1), scan_of(3)};
  ReplaySensor replay(recording, 0);
  bool first = true;
  for (const float range_m : {2.0F, 3.0F, 2.0F}) {
    ASSERT_EQ(replay.start(plan_with_id(), kNowUs), Status::kOk);
    EXPECT_EQ(replay.start(plan_with_id(), kNowUs), Status::kBusy);
    EXPECT_EQ(play(replay, kNowUs + 3'000).samples.size(), 4U);
    const Played rest = play(replay, kNowUs + 20'000);
    ASSERT_EQ(rest.samples.size(), 12U);
    EXPECT_TRUE(rest.last.complete);
    EXPECT_EQ(rest.samples[0].t_us, kNowUs + 4'000);
    EXPECT_EQ(rest.samples[0].range_m, range_m + 0.04F);
    EXPECT_EQ(play(replay, kNowUs + 30'000).last.status, Status::kNoData);
    EXPECT_EQ(replay.rounds(), range_m > 2 || first ? 0U : 1U);
    first = false;
  }
}

TEST(ReplaySensor, ServesOnlyPlansLikeTheRecorded) {
  VERIFIES("LASSO-SNS-031~1");
  const SensorRecording recording{scan_of(2)};
  ReplaySensor replay(recording, 0);
  const auto answer = [&](auto change) {
    ScanPlan plan = plan_with_id();
    change(plan);
    const Status status = replay.start(plan, kNowUs);
    replay.abort();
    return status;
  };
  const AimedRay aimed[1] = {}, elsewhere[1] = {{0.1F, -0.1F}};
  SensorRecording of_aimed{scan_of(2)};
  of_aimed[0].aimed.assign(1, AimedRay{});
  of_aimed[0].plan.points = 17;
  ScanPlan aimed_elsewhere = plan_with_id();
  aimed_elsewhere.points = 17;
  EXPECT_EQ(ReplaySensor(of_aimed, 0).start(aimed_elsewhere, kNowUs), Status::kBadValue);
  aimed_elsewhere.aimed = Span<const AimedRay>(elsewhere);
  EXPECT_EQ(ReplaySensor(of_aimed, 0).start(aimed_elsewhere, kNowUs), Status::kOk) << "their number counts";
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.scan_id = 77; }), Status::kOk);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.center_x += 0.019; }), Status::kOk);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.center_x += 0.021; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.center_y -= 0.021; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.half_x += 0.021; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.half_y += 0.021; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.phase_turns = 0.26; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.kind = PatternKind::kLissajous; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.points = 17; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.cycles_a = 7; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.cycles_b = 4; }), Status::kBadValue);
  EXPECT_EQ(answer([](ScanPlan& plan) { plan.duration_us = 16'000; }), Status::kBadValue);
  EXPECT_EQ(answer([&](ScanPlan& plan) { plan.aimed = Span<const AimedRay>(aimed); }), Status::kBadValue);
  EXPECT_EQ(replay.unserved(), 10U) << "what is no plan, of one aimed ray among 16, does not count";
  EXPECT_EQ(ReplaySensor(recording, 1).start(plan_with_id(), kNowUs), Status::kBadValue);
  const SensorRecording nothing;
  EXPECT_EQ(ReplaySensor(nothing, 0).start(plan_with_id(), kNowUs), Status::kBadValue);
}

TEST(ReplaySensor, AScanThatWasLostIsLostForTheSameReason) {
  VERIFIES("LASSO-SNS-031~1");
  const SensorRecording recording{scan_of(2, Status::kTruncated), scan_of(3, Status::kNoData)};
  ReplaySensor replay(recording, 0);
  ASSERT_EQ(replay.start(plan_with_id(), kNowUs), Status::kOk);
  EXPECT_EQ(play(replay, kNowUs + 20'000).samples.size(), 16U);
  EXPECT_EQ(play(replay, kNowUs + 20'000).last.status, Status::kTruncated);
  EXPECT_EQ(play(replay, kNowUs + 20'000).last.status, Status::kNoData);
  ASSERT_EQ(replay.start(plan_with_id(), kNowUs), Status::kOk);  // one that was aborted stays without an end
  const Played aborted = play(replay, kNowUs + 20'000);
  EXPECT_EQ(aborted.samples.size(), 16U);
  EXPECT_FALSE(aborted.last.complete);
  EXPECT_EQ(aborted.last.status, Status::kOk);
}

TEST(SensorRecorder, KeepsWhatTheSensorGave) {
  VERIFIES("LASSO-SNS-031~1");
  const SensorRecording played{scan_of(2), scan_of(3, Status::kBadOrder), scan_of(4)};
  ReplaySensor sensor(played, 0);
  SensorRecording recording;
  SensorRecorder recorder(sensor, 2, recording);
  EXPECT_EQ(play(recorder, kNowUs).last.status, Status::kNoData);
  ASSERT_EQ(recorder.start(plan_with_id(31), kNowUs), Status::kOk);
  EXPECT_TRUE(play(recorder, kNowUs + 20'000).last.complete);
  ASSERT_EQ(recorder.start(plan_with_id(32), kNowUs), Status::kOk);
  play(recorder, kNowUs + 20'000);
  EXPECT_EQ(play(recorder, kNowUs + 20'000).last.status, Status::kBadOrder);
  ASSERT_EQ(recorder.start(plan_with_id(33), kNowUs), Status::kOk);
  EXPECT_EQ(recorder.start(plan_with_id(34), kNowUs), Status::kBusy);
  play(recorder, kNowUs + 3'000);
  recorder.abort();
  play(recorder, kNowUs + 20'000);
  ASSERT_EQ(recording.size(), 3U);
  const Status ends[] = {Status::kOk, Status::kBadOrder, Status::kNoData};
  const std::size_t counts[] = {16, 16, 4};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(recording[i].sensor, 2);
    EXPECT_EQ(recording[i].plan.scan_id, 31 + i);
    EXPECT_EQ(recording[i].t_start_us, kNowUs);
    EXPECT_EQ(recording[i].end, ends[i]);
    EXPECT_EQ(recording[i].samples.size(), counts[i]);
  }
}

}  // namespace
}  // namespace lasso::sim
