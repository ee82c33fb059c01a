#include "fsw/exec/stored_log.hpp"

#include <gtest/gtest.h>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "ut/support/ram_store.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

EventRecord event_of(EventId id, Severity severity = Severity::kInformative, TimeUs t_us = 5) {
  EventRecord event;
  event.id = id;
  event.severity = severity;
  event.t_us = t_us;
  event.size = 2;
  event.items[0] = 0xAB;
  event.items[1] = 0xCD;
  return event;
}

class StoredLogTest : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kRecords = 64;  // of the store's area
  // As many slots as there is to write.
  static void drain(StoredLog& log) {
    for (int i = 0; i < 40; ++i) log.step();
  }
  // A record as it lies in the store, at a place of the ring.
  void put(std::size_t place, std::uint32_t sequence, std::uint32_t start, std::uint8_t size = 0) {
    std::uint8_t bytes[StoredLog::kRecordBytes] = {};
    ByteWriter writer{Bytes(bytes)};
    writer.u32(sequence);
    writer.u32(start);
    writer.i64(0);
    writer.u16(1);
    writer.u8(1);
    writer.u8(size);
    while (writer.size() < StoredLog::kRecordBytes - 4) writer.u8(0);
    writer.u32(crc32c(writer.written()));
    ASSERT_EQ(store_.write(StoreArea::kEventLog, place * StoredLog::kRecordBytes, ConstBytes(bytes)), Status::kOk);
  }
  test::RamStore store_{1000};
};

TEST_F(StoredLogTest, WhatWasToldIsThereAfterARestart) {
  VERIFIES("LASSO-HLT-005~2");
  StoredLog log;
  EXPECT_FALSE(log.in_use());
  log.note(event_of(EventId::kBegun));  // nowhere to keep it
  log.use(store_);
  ASSERT_TRUE(log.in_use());
  EXPECT_EQ(log.start(), 1U);
  log.note(event_of(EventId::kBegun));
  log.note(event_of(EventId::kParametersLost, Severity::kHigh, 77));
  drain(log);
  StoredLog next;
  next.use(store_);
  EXPECT_EQ(next.start(), 2U);
  EXPECT_EQ(next.sequence(), 2U);
  StoredEvent stored;
  ASSERT_TRUE(next.read(2, stored));
  EXPECT_EQ(stored.sequence, 2U);
  EXPECT_EQ(stored.start, 1U);
  EXPECT_EQ(stored.event.id, EventId::kParametersLost);
  EXPECT_EQ(stored.event.severity, Severity::kHigh);
  EXPECT_EQ(stored.event.t_us, 77);
  EXPECT_EQ(stored.event.size, 2);
  EXPECT_EQ(stored.event.items[1], 0xCD);
  EXPECT_FALSE(next.read(0, stored));
  EXPECT_FALSE(next.read(3, stored));
  EXPECT_FALSE(StoredLog().read(1, stored));
}

TEST_F(StoredLogTest, WhatAFloodOfCommandsTellsIsNotKept) {
  VERIFIES("LASSO-HLT-005~2");
  EXPECT_FALSE(StoredLog::is_kept(event_of(EventId::kCommandRefused, Severity::kLow)));
  EXPECT_TRUE(StoredLog::is_kept(event_of(EventId::kScanLost, Severity::kMedium)));
  for (const EventId id : {EventId::kBegun, EventId::kModeChanged, EventId::kLaserEnabled, EventId::kLaserInhibited,
                           EventId::kTimeCorrelated, EventId::kImageReady, EventId::kImageRefused, EventId::kImageActive,
                           EventId::kImageConfirmed, EventId::kFaultCleared, EventId::kParameterChanged, EventId::kParametersReverted,
                           EventId::kParametersRepaired, EventId::kParametersSaved, EventId::kParametersRestored, EventId::kResetCommanded})
    EXPECT_TRUE(StoredLog::is_kept(event_of(id)));
  StoredLog log;
  log.use(store_);
  log.note(event_of(EventId::kCommandRefused, Severity::kLow));
  EXPECT_EQ(log.sequence(), 0U);
}

TEST_F(StoredLogTest, TheOldestIsReplaced) {
  VERIFIES("LASSO-HLT-005~2");
  StoredLog log;
  log.use(store_);
  for (std::uint32_t i = 0; i < kRecords + 3; ++i) {
    log.note(event_of(EventId::kBegun, Severity::kInformative, i));
    log.step();
  }
  StoredEvent stored;
  EXPECT_FALSE(log.read(3, stored));
  ASSERT_TRUE(log.read(4, stored));
  EXPECT_EQ(stored.event.t_us, 3);
  StoredLog next;
  next.use(store_);
  EXPECT_EQ(next.sequence(), kRecords + 3);
}

TEST_F(StoredLogTest, NumbersWrapAndNoneIsZero) {
  VERIFIES("LASSO-HLT-005~2 LASSO-HLT-007~2");
  put(5, 0xFFFFFFFE, 0xFFFFFFFE);
  put(6, 0xFFFFFFFF, 0xFFFFFFFF);
  put(7, 0, 3);
  put(8, 0xFFFFFF00, 3, kMaxEventBytes + 1);
  StoredLog log;
  log.use(store_);
  EXPECT_EQ(log.sequence(), 0xFFFFFFFF);
  EXPECT_EQ(log.start(), 1U);
  log.note(event_of(EventId::kBegun));
  drain(log);
  EXPECT_EQ(log.sequence(), 1U);
  StoredLog next;
  next.use(store_);
  EXPECT_EQ(next.sequence(), 1U);
}

TEST_F(StoredLogTest, AnAreaHasItsRoomAndNoMoreThanItNeeds) {
  VERIFIES("LASSO-HLT-005~2");
  store_.of(StoreArea::kEventLog).resize(10);
  StoredLog none;
  none.use(store_);
  EXPECT_FALSE(none.in_use());
  store_.of(StoreArea::kEventLog).assign(2000 * StoredLog::kRecordBytes, 0);
  StoredLog log;
  log.use(store_);
  log.note(event_of(EventId::kBegun));
  drain(log);
  StoredEvent stored;
  EXPECT_TRUE(log.read(1, stored));
  EXPECT_FALSE(log.read(1 + StoredLog::kMaxRecords, stored));
}

TEST_F(StoredLogTest, WhatALossOfPowerCutShortIsAGap) {
  VERIFIES("LASSO-HLT-005~2 LASSO-IMG-015~1");
  StoredLog log;
  log.use(store_);
  for (int i = 0; i < 3; ++i) log.note(event_of(EventId::kBegun));
  drain(log);
  const std::uint8_t odd = 0xFF;
  ASSERT_EQ(store_.write(StoreArea::kEventLog, 3 * StoredLog::kRecordBytes + 30, ConstBytes(&odd, 1)), Status::kOk);
  StoredLog next;
  next.use(store_);
  EXPECT_EQ(next.sequence(), 2U);
  StoredEvent stored;
  EXPECT_FALSE(next.read(3, stored));
}

TEST_F(StoredLogTest, WhatFindsNoRoomOrIsNotTakenIsCounted) {
  VERIFIES("LASSO-HLT-005~2");
  StoredLog log;
  log.use(store_);
  for (int i = 0; i < 33; ++i) log.note(event_of(EventId::kBegun));
  EXPECT_EQ(log.lost(), 1U);
  store_.broken = true;
  StoredEvent stored;
  EXPECT_FALSE(log.read(1, stored));
  drain(log);
  EXPECT_EQ(log.lost(), 33U);
}

}  // namespace
}  // namespace lasso
