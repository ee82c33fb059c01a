#include "docs/embedding/cfs/bus_sensor.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <vector>

#include "docs/embedding/box.hpp"
#include "fsw/sense/pattern.hpp"
#include "ut/support/box_image.hpp"

namespace lasso::cfs {
namespace {

// What C programs on the bus count on: offsets by hand.
static_assert(sizeof(LASSO_Sample_t) == 32 && offsetof(LASSO_Sample_t, state) == 28);
static_assert(sizeof(LASSO_Samples_Payload_t) == 8 + 64 * 32 && offsetof(LASSO_Samples_Payload_t, status) == 7);
static_assert(sizeof(LASSO_Scan_Payload_t) == 80 + 384 * 8 && offsetof(LASSO_Scan_Payload_t, aimed) == 80);
static_assert(sizeof(LASSO_Pose_Payload_t) == 360 && offsetof(LASSO_Pose_Payload_t, covariance) == 72 &&
              offsetof(LASSO_Pose_Payload_t, valid) == 354);
static_assert(sizeof(LASSO_Start_Payload_t) == 112 && sizeof(LASSO_Config_t) == 72 && sizeof(LASSO_Housekeeping_Payload_t) == 28);
static_assert(LASSO_MAX_AIMED_RAYS == kMaxAimedRays && sizeof(PoseTelemetry::covariance) == sizeof(LASSO_Pose_Payload_t::covariance));

// A scanner at the other end, which keeps its orders.
class Port final : public ScannerPort {
 public:
  void send(const LASSO_Scan_Payload_t& order) override { orders.push_back(order); }
  std::vector<LASSO_Scan_Payload_t> orders;
};

ScanPlan small_plan(const AimedRays& aimed) {
  ScanPlan plan;
  plan.scan_id = 7;
  plan.points = 100;
  plan.cycles_a = 5;
  plan.cycles_b = 3;
  plan.phase_turns = 0.25;
  plan.center_x = 0.01;
  plan.center_y = -0.02;
  plan.half_x = 0.3;
  plan.half_y = 0.2;
  plan.duration_us = 150000;
  plan.aimed = aimed.span();
  return plan;
}

LASSO_Samples_Payload_t some_samples(std::uint32_t scan_id, std::uint16_t count, int first) {
  LASSO_Samples_Payload_t message{};
  message.scan_id = scan_id;
  message.count = count;
  for (int i = 0; i < count; ++i) message.samples[i] = {first + i, {0, 0, 1}, 2.5F, 1, 0};
  return message;
}

TEST(BusSensor, OrdersSayThePlan) {
  AimedRays aimed, back;
  for (int i = 0; i < 20; ++i) static_cast<void>(aimed.push_back({0.001F * static_cast<float>(i), -0.01F}));
  const ScanPlan plan = small_plan(aimed);
  const LASSO_Scan_Payload_t order = to_order(plan, 123456789);
  EXPECT_EQ(order.start_us, 123456789);
  const ScanPlan read = to_plan(order, back);
  ASSERT_EQ(validate(read), Status::kOk);
  EXPECT_EQ(read.scan_id, 7u);
  for (std::uint16_t ray = 0; ray < plan.points; ++ray) {
    EXPECT_EQ(pattern_direction(read, ray), pattern_direction(plan, ray));
    EXPECT_EQ(pattern_time_us(read, ray), pattern_time_us(plan, ray));
  }
}

TEST(BusSensor, WithoutPermissionNothingIsStarted) {
  Port port;
  BusSensor sensor(port);
  EXPECT_EQ(sensor.start(small_plan({}), 0), Status::kMissing);
  EXPECT_TRUE(port.orders.empty());
}

TEST(BusSensor, SamplesComeOnceAndInOrder) {
  Port port;
  BusSensor sensor(port);
  sensor.permit_laser(true);
  ASSERT_EQ(sensor.start(small_plan({}), 1000), Status::kOk);
  EXPECT_EQ(sensor.start(small_plan({}), 1000), Status::kBusy);
  EXPECT_EQ(port.orders.at(1).order, static_cast<std::uint32_t>(LASSO_ORDER_START));
  EXPECT_TRUE(sensor.take(some_samples(7, 64, 0)));
  LASSO_Samples_Payload_t last = some_samples(7, 36, 64);
  last.complete = 1;
  EXPECT_TRUE(sensor.take(last));
  EXPECT_FALSE(sensor.take(last)) << "it is complete";
  RangeSample out[80];
  const SensorPoll first = sensor.poll(0, out);
  EXPECT_EQ(first.count, 80u);
  EXPECT_FALSE(first.complete);
  EXPECT_EQ(out[79].t_us, 79);
  const SensorPoll second = sensor.poll(0, out);
  EXPECT_EQ(second.count, 20u);
  EXPECT_TRUE(second.complete);
  EXPECT_EQ(out[19].t_us, 99);
  EXPECT_EQ(out[19].state, RayState::kHit);
  EXPECT_EQ(sensor.poll(0, out).status, Status::kNoData);
}

TEST(BusSensor, WhatDoesNotBelongToTheScanChangesNothing) {
  Port port;
  BusSensor sensor(port);
  sensor.permit_laser(true);
  EXPECT_FALSE(sensor.take(some_samples(7, 1, 0))) << "no scan";
  ASSERT_EQ(sensor.start(small_plan({}), 0), Status::kOk);
  EXPECT_FALSE(sensor.take(some_samples(8, 1, 0))) << "another scan";
  LASSO_Samples_Payload_t longer = some_samples(7, 64, 0);
  longer.count = 65;
  EXPECT_FALSE(sensor.take(longer)) << "more than a message holds";
  EXPECT_TRUE(sensor.take(some_samples(7, 64, 0)));
  EXPECT_FALSE(sensor.take(some_samples(7, 64, 64))) << "more than the scan has rays";
  RangeSample out[80];
  EXPECT_EQ(sensor.poll(0, out).count, 64u);
}

TEST(BusSensor, AStateThatIsNoneSaysNothing) {
  Port port;
  BusSensor sensor(port);
  sensor.permit_laser(true);
  ASSERT_EQ(sensor.start(small_plan({}), 0), Status::kOk);
  LASSO_Samples_Payload_t message = some_samples(7, 1, 0);
  message.samples[0].state = 4;
  EXPECT_TRUE(sensor.take(message));
  RangeSample out[1];
  ASSERT_EQ(sensor.poll(0, out).count, 1u);
  EXPECT_EQ(out[0].state, RayState::kInvalid);
}

TEST(BusSensor, TheScannersStatusEndsTheScan) {
  Port port;
  BusSensor sensor(port);
  sensor.permit_laser(true);
  ASSERT_EQ(sensor.start(small_plan({}), 0), Status::kOk);
  LASSO_Samples_Payload_t refusal = some_samples(7, 0, 0);
  refusal.status = static_cast<std::uint8_t>(Status::kBadValue);
  EXPECT_TRUE(sensor.take(refusal));
  RangeSample out[1];
  EXPECT_EQ(sensor.poll(0, out).status, Status::kBadValue);
  EXPECT_EQ(sensor.start(small_plan({}), 0), Status::kOk) << "the next scan may begin";
}

TEST(BusSensor, AnInhibitEndsTheScanAtOnce) {
  Port port;
  BusSensor sensor(port);
  sensor.permit_laser(true);
  ASSERT_EQ(sensor.start(small_plan({}), 0), Status::kOk);
  sensor.permit_laser(false);
  EXPECT_EQ(port.orders.back().order, static_cast<std::uint32_t>(LASSO_ORDER_INHIBIT_LASER));
  RangeSample out[1];
  EXPECT_EQ(sensor.poll(0, out).status, Status::kMissing);
  sensor.abort();
  EXPECT_EQ(port.orders.back().order, static_cast<std::uint32_t>(LASSO_ORDER_INHIBIT_LASER)) << "nothing runs that could be aborted";
}

TEST(BusSensor, AnAbortIsPassedOn) {
  Port port;
  BusSensor sensor(port);
  sensor.permit_laser(true);
  ASSERT_EQ(sensor.start(small_plan({}), 0), Status::kOk);
  sensor.abort();
  EXPECT_EQ(port.orders.back().order, static_cast<std::uint32_t>(LASSO_ORDER_ABORT));
  EXPECT_EQ(port.orders.back().scan_id, 7u);
}

// A scanner of the box that has its plan by messages, and answers by messages.
class BoxAtTheBus final : public ScannerPort {
 public:
  BusSensor sensor{*this};
  void send(const LASSO_Scan_Payload_t& order) override {
    if (order.order != LASSO_ORDER_START) return;
    plan_ = to_plan(order, aimed_);
    start_us_ = order.start_us;
    next_ = 0;
  }
  // What has been measured by now.
  void deliver(TimeUs now_us) {
    while (next_ < plan_.points && time_of(next_) <= now_us) {
      LASSO_Samples_Payload_t message{};
      message.scan_id = plan_.scan_id;
      for (; next_ < plan_.points && message.count < LASSO_SAMPLES_PER_MESSAGE && time_of(next_) <= now_us; ++next_, ++message.count) {
        message.samples[message.count] = to_message(measure_box(box_pose(), pattern_direction(plan_, next_), time_of(next_)));
      }
      message.complete = next_ == plan_.points ? 1 : 0;
      EXPECT_TRUE(sensor.take(message));
    }
  }

 private:
  TimeUs time_of(std::uint16_t ray) const { return start_us_ + pattern_time_us(plan_, ray); }
  ScanPlan plan_;
  AimedRays aimed_;
  TimeUs start_us_ = 0;
  std::uint16_t next_ = plan_.points;
};

TEST(BusSensor, ItsPosesAreThoseOfThePackets) {
  MissionParameters parameters = preset_parameters();
  parameters.start_check = 0;
  test::TestImage image = test::make_box_image(parameters);
  BoxAtTheBus box;
  alignas(required_alignment()) static std::uint8_t memory[required_memory()];
  Component* component = create(memory, sizeof memory, box.sensor);
  ASSERT_NE(component, nullptr);
  ASSERT_EQ(load_image(*component, {image.data(), image.size}).status, Status::kOk);
  ASSERT_EQ(begin(*component, 0), Status::kOk);
  box.sensor.permit_laser(true);  // on the bus: by the command enable_laser
  ASSERT_EQ(start_tracking(*component, box_pose(), {}, 0), Status::kOk);
  int poses = 0;
  for (TimeUs now_us = 0; now_us < 1000000; now_us += 10000) {
    box.deliver(now_us);
    while (step(*component, now_us)) {
    }
    std::uint8_t bytes[kMaxPosePacketBytes];
    ConstBytes rest(bytes, take_telemetry(*component, bytes));
    for (std::size_t size = 0; !rest.empty(); rest = rest.subspan(size, rest.size() - size)) {
      size = packet_size(rest);
      PacketHeader header;
      PoseTelemetry pose;
      if (decode_pose(rest.first(size), header, pose) != PacketFault::kNone) continue;
      const LASSO_Pose_Payload_t message = to_message(pose);
      EXPECT_EQ(message.scan_id, pose.scan_id);
      EXPECT_EQ(message.valid, 1);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(message.p_sensor_target_m[i], box_pose().p[i], 2e-4);
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(message.q_sensor_target[i], box_pose().q.coeffs()[i], 2e-4);
      EXPECT_EQ(std::memcmp(message.covariance, pose.covariance, sizeof pose.covariance), 0);
      EXPECT_EQ(std::memcmp(message.filter_v_mps, pose.filter_v_mps, sizeof pose.filter_v_mps), 0);
      EXPECT_EQ(message.t_measurement_us, pose.t_measurement_us);
      ++poses;
    }
  }
  EXPECT_EQ(poses, 3);
}

}  // namespace
}  // namespace lasso::cfs
