// What outlives a restart, as an operator sees it: saved parameters, the event log, the cause of the reset.
#include "fsw/mission/stored_record.hpp"
#include "ut/exec/component_operator.hpp"
#include "ut/exec/memory_scene.hpp"
#include "ut/support/parameter_row.hpp"

namespace lasso {
namespace {

using test::id_of;
using test::Packet;

class ComponentStore : public ::testing::Test {
 protected:
  ComponentStore() : coast_(id_of("tracking.coast_frames")) { scene_.begin(image_); }
  Component& component() { return *scene_.component; }
  std::uint16_t next() { return count_++; }

  ServiceRefusal send(const test::Stream& packet) {
    EXPECT_TRUE(component().receive_packet(test::view(packet), component().next_slot_us()));
    return test::answer_in(take());
  }
  std::vector<Packet> take() {
    test::Stream bytes(kTelemetryQueueBytes);
    bytes.resize(component().take_telemetry(Bytes(bytes.data(), bytes.size())));
    std::vector<Packet> packets = test::packets_of(bytes);
    for (const Packet& packet : packets) {
      if (packet.is(5, kSubserviceStoredEvent)) stored_.push_back(decoded(packet));
      const bool event = packet.header.service == kServiceEvent && packet.header.subservice <= 4;
      if (event) events_.push_back(static_cast<EventId>(packet.data[0] << 8 | packet.data[1]));
    }
    return packets;
  }
  static StoredEventTelemetry decoded(const Packet& packet) {
    StoredEventTelemetry event;
    ByteReader in(test::view(packet.data));
    codec_of(link_report_rows::kStoredEvent).read(in, event);
    return event;
  }
  void run(int frames) {
    for (int i = 0; i < frames; ++i) {
      do {
        component().run_slot(component().next_slot_us());
        component().run_estimation();
      } while (!component().next_slot_is_boundary());
      take();
    }
  }
  // With the same store; the board says why.
  void restart(ResetCause cause) {
    scene_.restart();
    component().set_reset_cause(cause);
    events_.clear();
    stored_.clear();
    scene_.begin(image_);
  }
  ServiceRefusal report_stored(std::uint32_t last, std::uint8_t count) {
    stored_.clear();
    return send(test::report_stored(last, count, next()));
  }
  bool told(EventId id) const { return std::count(events_.begin(), events_.end(), id) > 0; }
  double coast_frames() { return component().mission().parameters.coast_frames; }

  test::TestImage image_ = test::make_box_image(test::MemoryScene::parameters(), test::BoxModel{});
  test::MemoryScene scene_;
  std::uint16_t coast_;
  std::uint16_t count_ = 0;
  std::vector<EventId> events_;
  std::vector<StoredEventTelemetry> stored_;
};

TEST_F(ComponentStore, WhatAnOperatorDoesNotWantToBeToldIsKeptAllTheSame) {
  VERIFIES("LASSO-HLT-005~2");
  const auto event = static_cast<std::uint16_t>(EventId::kParameterChanged);
  ASSERT_EQ(send(test::disable_event(event, next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::set_parameter(coast_, 33, next())), ServiceRefusal::kNone);
  run(2);
  EXPECT_FALSE(told(EventId::kParameterChanged));
  ASSERT_EQ(report_stored(0, 8), ServiceRefusal::kNone);
  EXPECT_TRUE(std::any_of(stored_.begin(), stored_.end(), [&](const auto& stored) { return stored.event == event; }));
}

TEST_F(ComponentStore, ParametersAreSavedAndHoldAgainAfterARestart) {
  VERIFIES("LASSO-IMG-019~1 LASSO-IMG-015~1");
  const double before = coast_frames();
  EXPECT_EQ(send(test::plain_packet(CommandKind::kRestoreParameters, next())), ServiceRefusal::kNothingStored);
  ASSERT_EQ(send(test::set_parameter(coast_, 33, next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::plain_packet(CommandKind::kSaveParameters, next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::set_parameter(coast_, 44, next())), ServiceRefusal::kNone);
  run(1);
  EXPECT_TRUE(told(EventId::kParametersSaved));
  EXPECT_EQ(coast_frames(), 44);
  ASSERT_EQ(send(test::plain_packet(CommandKind::kRestoreParameters, next())), ServiceRefusal::kNone);
  run(1);
  EXPECT_EQ(coast_frames(), 33);
  ASSERT_EQ(send(test::plain_packet(CommandKind::kRevertParameters, next())), ServiceRefusal::kNone);
  run(1);
  EXPECT_EQ(coast_frames(), before);
  restart(ResetCause::kPowerOn);
  run(1);
  EXPECT_TRUE(told(EventId::kParametersRestored));
  EXPECT_EQ(coast_frames(), 33);
}

TEST_F(ComponentStore, WhatCannotBeSavedOrDoesNotHoldIsTold) {
  VERIFIES("LASSO-IMG-019~1");
  ASSERT_EQ(send(test::plain_packet(CommandKind::kSaveParameters, next())), ServiceRefusal::kNone);
  std::uint8_t of_others[kSavedParameterBytes] = {};
  ASSERT_EQ(save_record(scene_.store, StoreArea::kParameters0, StoreArea::kParameters1, ConstBytes(of_others)), Status::kOk);
  EXPECT_EQ(send(test::plain_packet(CommandKind::kRestoreParameters, next())), ServiceRefusal::kOtherTable);
  run(1);
  EXPECT_TRUE(told(EventId::kParametersRestored));
  scene_.store.broken = true;
  EXPECT_EQ(send(test::plain_packet(CommandKind::kSaveParameters, next())), ServiceRefusal::kStoreFailed);
}

TEST_F(ComponentStore, WithoutAStoreNothingIsKept) {
  VERIFIES("LASSO-IMG-019~1 LASSO-HLT-005~2");
  scene_.component = std::make_unique<Component>(scene_.sensor);
  scene_.begin(image_);
  EXPECT_EQ(send(test::plain_packet(CommandKind::kSaveParameters, next())), ServiceRefusal::kNoStore);
  EXPECT_EQ(send(test::plain_packet(CommandKind::kRestoreParameters, next())), ServiceRefusal::kNoStore);
  EXPECT_EQ(report_stored(0, 1), ServiceRefusal::kNoStore);
}

TEST_F(ComponentStore, TheLogAndTheCauseSurviveARestart) {
  VERIFIES("LASSO-HLT-005~2 LASSO-IMG-015~1");
  EXPECT_EQ(report_stored(0, 1), ServiceRefusal::kNothingStored);
  run(2);
  ASSERT_EQ(send(test::set_parameter(coast_, 33, next())), ServiceRefusal::kNone);
  run(2);
  restart(ResetCause::kInvariant);
  run(2);
  ASSERT_EQ(report_stored(0, 8), ServiceRefusal::kNone);
  std::vector<std::uint8_t> causes;
  bool changed = false;
  for (const StoredEventTelemetry& event : stored_) {
    if (event.event == static_cast<std::uint16_t>(EventId::kBegun)) causes.push_back(event.items[12]);
    changed = changed || (event.event == static_cast<std::uint16_t>(EventId::kParameterChanged) && event.start == 1);
  }
  EXPECT_EQ(causes, (std::vector<std::uint8_t>{0, static_cast<std::uint8_t>(ResetCause::kInvariant)}));
  EXPECT_TRUE(changed);
  EXPECT_EQ(stored_.back().start, 2U);
  ASSERT_EQ(report_stored(1, 1), ServiceRefusal::kNone);
  ASSERT_EQ(stored_.size(), 1U);
  EXPECT_EQ(stored_[0].event, static_cast<std::uint16_t>(EventId::kBegun));
}

TEST_F(ComponentStore, AResetIsArmedAndAskedOfTheBoardWhenItHasBeenTold) {
  VERIFIES("LASSO-LNK-017~2");
  EXPECT_EQ(send(test::plain_packet(CommandKind::kReset, next())), ServiceRefusal::kNotArmed);
  ASSERT_EQ(send(test::arm(CommandKind::kEnableLaser, next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::plain_packet(CommandKind::kEnableLaser, next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::arm(CommandKind::kReset, next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::plain_packet(CommandKind::kReset, next())), ServiceRefusal::kNone);
  EXPECT_FALSE(component().reset_due());
  run(1);
  EXPECT_TRUE(component().reset_due());
  EXPECT_TRUE(told(EventId::kLaserInhibited));
  EXPECT_TRUE(told(EventId::kResetCommanded));
  restart(ResetCause::kCommanded);
  EXPECT_FALSE(component().reset_due());
  run(1);
  ASSERT_EQ(report_stored(0, 8), ServiceRefusal::kNone);
  EXPECT_TRUE(std::any_of(stored_.begin(), stored_.end(), [](const StoredEventTelemetry& event) {
    return event.event == static_cast<std::uint16_t>(EventId::kResetCommanded);
  }));
}

}  // namespace
}  // namespace lasso
