#include "fsw/link/event_log.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using Stream = std::vector<std::uint8_t>;

Stream items_of(const EventRecord& event) { return {event.items, event.items + event.size}; }

TEST(EventLog, KeepsWhatIsRaisedInOrderWithTimeAndItems) {
  VERIFIES("LASSO-LNK-015~2");
  EventLog log;
  log.set_time(7);
  log.raise<EventId::kBegun>(0x01020304U, 5U, 0xFFFFFFFFU, 2);
  log.set_time(8);
  log.raise<EventId::kPartInconsistent>(3, -2.5);
  ASSERT_EQ(log.records().size(), 2u);
  EXPECT_EQ(log.records()[0].id, EventId::kBegun);
  EXPECT_EQ(log.records()[0].severity, Severity::kInformative);
  EXPECT_EQ(log.records()[0].t_us, 7);
  EXPECT_EQ(items_of(log.records()[0]), (Stream{1, 2, 3, 4, 0, 0, 0, 5, 0xFF, 0xFF, 0xFF, 0xFF, 2}));
  EXPECT_EQ(log.records()[1].t_us, 8);
  EXPECT_EQ(items_of(log.records()[1]), (Stream{3, 0xC0, 0x20, 0, 0}));
  log.pass_boundary();
  EXPECT_TRUE(log.records().empty());
}

// Records that are to be reported.
std::vector<EventId> told(const EventLog& log) {
  std::vector<EventId> ids;
  for (const EventRecord& event : log.records()) {
    if (event.reported) ids.push_back(event.id);
  }
  return ids;
}

TEST(EventLog, ADisabledEventIsNotToldUntilItIsEnabled) {
  VERIFIES("LASSO-LNK-015~2");
  EventLog log;
  EXPECT_TRUE(log.set_enabled(2, false));
  EXPECT_TRUE(log.set_enabled(9, false));
  log.raise<EventId::kModeChanged>(1, 2, 3);
  log.raise<EventId::kSensorBack>(1);
  EXPECT_EQ(told(log), std::vector<EventId>{EventId::kSensorBack});
  EXPECT_EQ(log.records().size(), 2u) << "for the log that is kept";
  EXPECT_EQ(log.disabled().mask[0], 0x04);
  EXPECT_EQ(log.disabled().mask[1], 0x02);
  EXPECT_TRUE(log.set_enabled(2, true));
  log.raise<EventId::kModeChanged>(1, 2, 3);
  EXPECT_EQ(told(log).size(), 2u);
  EXPECT_EQ(log.disabled().mask[0], 0);
  EXPECT_FALSE(log.set_enabled(0, false));
  EXPECT_FALSE(log.set_enabled(static_cast<std::uint16_t>(EventId::kEnd), false));
}

// Against a count by hand: windows begin with the first one, and last so many frames.
TEST(EventLog, TellsNoMoreThanTheRowAllows) {
  VERIFIES("LASSO-LNK-015~2");
  EventLog log;
  const Throttle throttle = event_rows::row_of(EventId::kScanLost).throttle;
  ASSERT_EQ(throttle.most, 4);
  ASSERT_EQ(throttle.frames, 25);
  std::size_t told = 0;
  std::vector<Stream> suppressed;
  for (int frame = 0; frame < 52; ++frame) {
    if (frame < 30) log.raise<EventId::kScanLost>(1, frame, 3);
    for (const EventRecord& event : log.records()) {
      if (event.id == EventId::kScanLost) ++told;
      if (event.id == EventId::kEventsSuppressed) suppressed.push_back(items_of(event));
    }
    log.pass_boundary();
  }
  EXPECT_EQ(told, 8u) << "4 of frames 0 to 24, and 4 of frames 25 to 29";
  ASSERT_EQ(suppressed.size(), 2u);
  EXPECT_EQ(suppressed[0], (Stream{0, 11, 0, 0, 0, 21}));
  EXPECT_EQ(suppressed[1], (Stream{0, 11, 0, 0, 0, 1}));
}

TEST(EventLog, AnEventThatIsNeverSuppressedSaysNothingOfIt) {
  VERIFIES("LASSO-LNK-015~2");
  EventLog log;
  log.raise<EventId::kScanLost>(0, 0, 0);
  for (int frame = 0; frame < 60; ++frame) {
    log.pass_boundary();
    EXPECT_TRUE(log.records().empty());
  }
}

TEST(EventLog, WhatWasSuppressedOfADisabledEventIsNotTold) {
  VERIFIES("LASSO-LNK-015~2");
  EventLog log;
  EXPECT_TRUE(log.set_enabled(static_cast<std::uint16_t>(EventId::kScanLost), false));
  for (int frame = 0; frame < 60; ++frame) {
    for (int i = 0; i < 9; ++i) log.raise<EventId::kScanLost>(0, 0, 0);
    EXPECT_TRUE(told(log).empty());
    EXPECT_LE(log.records().size(), 4u) << "throttled as ever";
    log.pass_boundary();
  }
}

TEST(EventLog, CountsWhatAFrameDoesNotHold) {
  VERIFIES("LASSO-LNK-015~2");
  EventLog log;
  for (std::size_t i = 0; i < kMaxEventsPerFrame + 5; ++i) log.raise<EventId::kModeChanged>(0, 0, i);
  ASSERT_EQ(log.records().size(), kMaxEventsPerFrame);
  EXPECT_EQ(items_of(log.records()[kMaxEventsPerFrame - 1]), (Stream{0, 0, static_cast<std::uint8_t>(kMaxEventsPerFrame - 1)}))
      << "the first ones stay";
  EXPECT_EQ(log.dropped(), 5u);
  log.pass_boundary();
  ASSERT_EQ(log.records().size(), 1u);
  EXPECT_EQ(log.records()[0].id, EventId::kEventsDropped);
  EXPECT_EQ(items_of(log.records()[0]), (Stream{0, 0, 0, 5}));
  log.pass_boundary();
  EXPECT_TRUE(log.records().empty());
}

// The frames that are left of the only window that is open.
std::uint16_t& frames_left(EventLog& log) {
  auto* const words = reinterpret_cast<std::uint16_t*>(&log);
  const std::vector<std::uint16_t> before(words, words + sizeof(EventLog) / sizeof(std::uint16_t));
  log.pass_boundary();
  const auto window = std::mismatch(before.begin(), before.end(), words).first - before.begin();
  EXPECT_EQ(words[window], before[static_cast<std::size_t>(window)] - 1);
  return words[window];
}

// In a window of kEstimateLate that a flip meets in its frame `at`: in which frame what was suppressed is told.
int told_in(unsigned bit, int at, bool goes_on) {
  constexpr int kGivenUp = 1000;
  EventLog log;
  const auto storm = [&] {
    for (int i = 0; i < 100; ++i) log.raise<EventId::kEstimateLate>(i);
  };
  storm();
  log.pass_boundary();
  std::uint16_t& left = frames_left(log);
  for (int frame = 2; frame < kGivenUp; ++frame) {
    if (frame == at) left = static_cast<std::uint16_t>(left ^ 1u << bit);
    if (goes_on) storm();
    for (const EventRecord& event : log.records()) {
      if (event.id == EventId::kEventsSuppressed) return frame;
    }
    log.pass_boundary();
  }
  return kGivenUp;
}

// A window of a length that no row has would keep events back for hours, and one that a flip has ended would never tell what it suppressed.
TEST(EventLog, AFlippedBitOfAWindowKeepsNothingBackForMoreThanAnother) {
  VERIFIES("LASSO-HLT-014~3");
  constexpr int kWindow = event_rows::row_of(EventId::kEstimateLate).throttle.frames;
  ASSERT_EQ(told_in(0, -1, false), kWindow) << "without a flip";
  for (unsigned bit = 0; bit < 16; ++bit) {
    for (int at = 2; at < kWindow; ++at) {
      EXPECT_LE(told_in(bit, at, false), 2 * kWindow) << bit << " in frame " << at;
      EXPECT_LE(told_in(bit, at, true), 2 * kWindow) << bit << " in frame " << at;
    }
  }
}

// A bit that opens a window which nobody began, after one that was full: what comes then is told in it, or counted at its end.
TEST(EventLog, AFlippedBitThatOpensAWindowKeepsNothingBackForMoreThanIt) {
  VERIFIES("LASSO-HLT-014~3");
  constexpr int kWindow = event_rows::row_of(EventId::kEstimateLate).throttle.frames;
  for (unsigned bit = 0; bit < 16; ++bit) {
    EventLog log;
    for (int i = 0; i < 4; ++i) log.raise<EventId::kEstimateLate>(i);
    log.pass_boundary();
    std::uint16_t& left = frames_left(log);
    while (left > 0) log.pass_boundary();
    left = static_cast<std::uint16_t>(1u << bit);
    log.raise<EventId::kEstimateLate>(4);
    int frames = 0;
    for (; frames < 1000 && log.records().empty(); ++frames) log.pass_boundary();
    EXPECT_LE(frames, kWindow) << bit;
  }
}

// Nothing is lost without being counted: reported, suppressed and dropped make up all that was raised.
TEST(EventLog, EveryEventOfAStormIsToldOrCounted) {
  VERIFIES("LASSO-LNK-015~2");
  EventLog log;
  test::Generator random(5);
  std::uint32_t raised = 0, told = 0, suppressed = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    const std::uint64_t storm = frame < 900 ? random.below(40) : 0;
    for (std::uint64_t i = 0; i < storm; ++i, ++raised) log.raise<EventId::kEstimateLate>(i);
    for (const EventRecord& event : log.records()) {
      if (event.id == EventId::kEstimateLate) ++told;
      if (event.id == EventId::kEventsSuppressed) suppressed += static_cast<std::uint32_t>(event.items[4] << 8 | event.items[5]);
    }
    ASSERT_LE(log.records().size(), 6u);
    log.pass_boundary();
  }
  EXPECT_GT(told, 100u);
  EXPECT_EQ(told + suppressed, raised);
}

TEST(EventLog, WritesEachTypeOfTheWire) {
  VERIFIES("LASSO-LNK-002~1");
  std::uint8_t bytes[27];
  ByteWriter writer{Bytes(bytes)};
  for (const WireType type : {WireType::kU8, WireType::kU16, WireType::kU32, WireType::kI64, WireType::kF32, WireType::kF64})
    write_value(type, {-2, 1.5}, writer);
  EXPECT_EQ(Stream(bytes, bytes + sizeof bytes), (Stream{0xFE, 0xFF, 0xFE, 0xFF, 0xFF, 0xFF, 0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                                                         0xFE, 0x3F, 0xC0, 0,    0,    0x3F, 0xF8, 0,    0,    0,    0,    0,    0}));
  EventLog log;
  log.raise<EventId::kCommandFailed>(0x1FF, 2, 0x10304, 5, 6, 7);
  EXPECT_EQ(items_of(log.records()[0]), (Stream{0xFF, 2, 3, 4, 5, 6, 7})) << "u8 and u16, cut as they are";
}

}  // namespace
}  // namespace lasso
