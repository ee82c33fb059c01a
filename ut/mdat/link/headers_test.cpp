#include "mdat/link/headers.hpp"

#include <chrono>

#include "fsw/core/crc.hpp"
#include "mdat/link/headers_text.hpp"
#include "mdat/link/stream_crc.hpp"
#include "ut/link/command_packets.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::Stream;
using test::view;

// A packet of telemetry of 20 bytes, as any application may send it; the bytes say `epoch`, so that those of two runs differ.
struct Sent {
  std::uint16_t apid = 0x4C0;
  std::uint16_t count = 0;
  std::uint8_t epoch = 0;
  bool checked = true;
};
Stream sent(const Sent& what) {
  Stream bytes(20, what.epoch);
  const std::uint8_t head[] = {static_cast<std::uint8_t>(what.apid >> 8),
                               static_cast<std::uint8_t>(what.apid),
                               static_cast<std::uint8_t>(0xC0 | what.count >> 8),
                               static_cast<std::uint8_t>(what.count),
                               0,
                               13};
  std::copy(std::begin(head), std::end(head), bytes.begin());
  bytes[7] = static_cast<std::uint8_t>(what.count);
  const std::uint16_t crc = what.checked ? crc16_ccitt(ConstBytes(bytes.data(), bytes.size() - 2)) : 0;
  bytes[18] = static_cast<std::uint8_t>(crc >> 8);
  bytes[19] = static_cast<std::uint8_t>(crc);
  return bytes;
}

void add(Stream& stream, const Stream& more) { stream.insert(stream.end(), more.begin(), more.end()); }
void add_counts(Stream& stream, const std::vector<int>& counts, std::uint8_t epoch = 0) {
  for (const int count : counts) add(stream, sent({0x4C0, static_cast<std::uint16_t>(count & 0x3FFF), epoch, true}));
}
std::vector<int> from_to(int from, int to) {
  std::vector<int> counts;
  for (int count = from; count < to; ++count) counts.push_back(count);
  return counts;
}

// The summary from "gap" to "repeated".
std::string sequence_of(const Stream& stream) {
  const std::string text = headers_summary(list_headers(view(stream)));
  const std::size_t begin = text.find("; ") + 2;
  return text.substr(begin, text.rfind("; ") - begin);
}
std::string summary_of(const Stream& stream) { return headers_summary(list_headers(view(stream))); }

TEST(StreamCrc, AgreesWithTheChecksumOfEachPiece) {
  VERIFIES("LASSO-GND-021~2");
  test::Generator random(7);
  Stream stream(300);
  for (std::uint8_t& byte : stream) byte = static_cast<std::uint8_t>(random.bits());
  const std::uint16_t crc = crc16_ccitt(ConstBytes(stream.data() + 31, 200));
  stream[231] = static_cast<std::uint8_t>(crc >> 8);
  stream[232] = static_cast<std::uint8_t>(crc);
  const StreamCrc sums(view(stream));
  EXPECT_TRUE(sums.right(31, 202));
  for (std::size_t at = 0; at < 90; ++at) {
    for (std::size_t size = 2; size < 210; ++size) {
      EXPECT_EQ(sums.right(at, size), crc16_ccitt(ConstBytes(stream.data() + at, size)) == 0) << at << " " << size;
    }
  }
}

TEST(Headers, ListsAnyPacketsGapsAndChecksums) {
  VERIFIES("LASSO-GND-021~2");
  // Two applications, one with the type of commands; a count that wraps; a gap of 2; a wrong checksum.
  Stream stream;
  add_counts(stream, {0x3FFF});
  add(stream, sent({0x14C0, 5}));
  add_counts(stream, {0, 3});
  Stream wrong = sent({0x14C0, 6});
  wrong[9] ^= 1;
  add(stream, wrong);
  add(stream, {0x04, 0xC0, 0xC0});
  const HeaderList list = list_headers(view(stream));
  ASSERT_EQ(list.lines.size(), 5U);
  EXPECT_EQ(list.left_over, 3U);
  EXPECT_EQ(list.lines[0].header.apid, 0x4C0);
  EXPECT_EQ(list.lines[1].header.type, PacketType::kCommand);
  EXPECT_EQ(list.lines[3].missing, 2U);
  EXPECT_EQ(list.lines[4].checksum, Checksum::kWrong);
  EXPECT_EQ(
      headers_summary(list),
      "5 packets: CRC right in 4, wrong in 1; 1 gap in the sequence, 2 packets missing; 0 restarts, 0 late, 0 repeated; 0 bytes skipped, 3 "
      "left over\n");
  EXPECT_NE(headers_table(list).find("2 packets missing before\n"), std::string::npos);
}

TEST(Headers, ARestartIsToldOnceAndItsGapsAre) {
  VERIFIES("LASSO-GND-021~2");
  for (const std::uint8_t epoch : {std::uint8_t{0}, std::uint8_t{1}}) {  // with the same bytes again, or others
    Stream stream;
    add_counts(stream, from_to(0, 100));
    add_counts(stream, from_to(0, 20), epoch);
    add_counts(stream, from_to(30, 60), epoch);
    EXPECT_EQ(sequence_of(stream), "1 gap in the sequence, 10 packets missing; 1 restart, 0 late, 0 repeated");
    add_counts(stream, from_to(0, 300), 2);  // beyond all that was before
    EXPECT_EQ(sequence_of(stream), "1 gap in the sequence, 10 packets missing; 2 restarts, 0 late, 0 repeated");
  }
}

TEST(Headers, RestartsOfAnyKind) {
  VERIFIES("LASSO-GND-021~2");
  const struct {
    std::vector<int> before, behind;
    const char* said;
  } cases[] = {
      {from_to(5000, 5100), from_to(0, 50), "0 gaps in the sequence, 0 packets missing; 1 restart, 0 late, 0 repeated"},
      {from_to(5000, 5100), from_to(1, 50), "0 gaps in the sequence, 0 packets missing; 1 restart, 0 late, 0 repeated"},
      {from_to(5000, 5100), from_to(3000, 3050), "0 gaps in the sequence, 0 packets missing; 1 restart, 0 late, 0 repeated"},
      {from_to(16000, 16100), from_to(0, 50),
       "0 gaps in the sequence, 0 packets missing; 1 restart, 0 late, 0 repeated"},  // half of all ahead
      {from_to(16370, 16384), from_to(0, 50), "0 gaps in the sequence, 0 packets missing; 0 restarts, 0 late, 0 repeated"},  // wraps
      {from_to(16370, 16380), from_to(0, 50), "1 gap in the sequence, 4 packets missing; 0 restarts, 0 late, 0 repeated"},
      {from_to(16370, 16380), from_to(3, 50), "1 gap in the sequence, 7 packets missing; 0 restarts, 0 late, 0 repeated"},
      {{5, 6, 7},
       {1, 0, 2},
       "0 gaps in the sequence, 0 packets missing; 1 restart, 1 late, 0 repeated"},  // the first two have changed places
      {{5, 6, 7}, {1, 0, 2, 4, 5, 6}, "1 gap in the sequence, 1 packet missing; 1 restart, 1 late, 0 repeated"},
      {from_to(100, 110), {50, 110}, "0 gaps in the sequence, 0 packets missing; 0 restarts, 1 late, 0 repeated"},
      {from_to(0, 10), from_to(5000, 5050), "1 gap in the sequence, 4990 packets missing; 0 restarts, 0 late, 0 repeated"},
      {from_to(0, 10), {0}, "0 gaps in the sequence, 0 packets missing; 1 restart, 0 late, 0 repeated"}};
  for (const auto& one : cases) {
    Stream stream;
    add_counts(stream, one.before);
    add_counts(stream, one.behind, 1);
    EXPECT_EQ(sequence_of(stream), one.said) << one.before.front() << " " << one.behind.front();
  }
}

// The counter was at 0 in between, whether it went on or began anew.
TEST(Headers, AGapThatMayBeARestartIsToldAsEither) {
  VERIFIES("LASSO-GND-021~2");
  Stream stream;
  add_counts(stream, {9028, 9029, 100, 101});
  EXPECT_NE(headers_table(list_headers(view(stream))).find("7454 packets missing before, or a restart with 100 missing\n"),
            std::string::npos);
  EXPECT_NE(summary_of(stream).find("\n1 gap may be a restart"), std::string::npos) << summary_of(stream);
  Stream forward;
  add_counts(forward, {100, 7555, 16380, 10});
  EXPECT_EQ(summary_of(forward).find("may be a restart"), std::string::npos) << "9 counts across 0 are a usual loss, and 7454 short of it";
}

TEST(Headers, LateAndRepeatedPacketsAreNoRestart) {
  VERIFIES("LASSO-GND-021~2");
  const struct {
    std::vector<int> counts;
    const char* said;
  } cases[] = {
      {{0x3FFE, 0x3FFF, 0x3FFF, 0, 0x3FFF, 1, 3, 2, 4}, "0 gaps in the sequence, 0 packets missing; 0 restarts, 1 late, 2 repeated"},
      {{1, 2, 6, 4, 3, 7}, "1 gap in the sequence, 1 packet missing; 0 restarts, 2 late, 0 repeated"},
      {{9, 13, 14, 15, 10, 11, 12, 16}, "0 gaps in the sequence, 0 packets missing; 0 restarts, 3 late, 0 repeated"},
      {{10, 11, 12, 10, 11, 12, 13}, "0 gaps in the sequence, 0 packets missing; 0 restarts, 0 late, 3 repeated"},
      {{10, 11, 12, 11, 15}, "1 gap in the sequence, 2 packets missing; 0 restarts, 0 late, 1 repeated"},
      {{10, 11, 12, 12}, "0 gaps in the sequence, 0 packets missing; 0 restarts, 0 late, 1 repeated"},
      {{0, 1, 0, 2}, "0 gaps in the sequence, 0 packets missing; 0 restarts, 0 late, 1 repeated"},
      {{0, 0, 0, 0}, "0 gaps in the sequence, 0 packets missing; 0 restarts, 0 late, 3 repeated"}};  // a source that does not count
  for (const auto& one : cases) {
    Stream stream;
    add_counts(stream, one.counts);
    EXPECT_EQ(sequence_of(stream), one.said) << one.counts[0] << " " << one.counts[1] << " " << one.counts[2];
  }
}

TEST(Headers, ADamagedCountStartsNothing) {
  VERIFIES("LASSO-GND-021~2");
  Stream stream;
  add_counts(stream, from_to(0, 10));
  Stream damaged = sent({0x4C0, 10});
  damaged[2] ^= 0x20;  // of the count
  add(stream, damaged);
  add_counts(stream, from_to(11, 20));
  EXPECT_EQ(summary_of(stream),
            "20 packets: CRC right in 19, wrong in 1; 1 gap in the sequence, 1 packet missing; 0 restarts, 0 late, 0 repeated; 0 bytes "
            "skipped, 0 "
            "left over\n");
}

TEST(Headers, IdlePacketsHaveNoSequenceAndNoChecksum) {
  VERIFIES("LASSO-GND-021~2");
  Stream stream;
  for (int count = 0; count < 20; ++count) {
    add_counts(stream, {count});
    Stream idle(9 + static_cast<std::size_t>(count) % 3, 0x55);
    const std::uint8_t head[] = {0x07, 0xFF, 0xC0, 0, 0, static_cast<std::uint8_t>(idle.size() - 7)};
    std::copy(std::begin(head), std::end(head), idle.begin());
    add(stream, idle);
  }
  const HeaderList list = list_headers(view(stream));
  EXPECT_EQ(headers_summary(list),
            "40 packets, 20 of them idle: CRC right in 20, wrong in 0, none in 20; 0 gaps in the sequence, 0 packets missing; 0 restarts, "
            "0 late, 0 "
            "repeated; 0 bytes skipped, 0 left over\n");
  EXPECT_EQ(list.lines[1].step, SequenceStep::kIdle);
  EXPECT_NE(headers_csv(list).find("20,2047,telemetry,0,3,0,9,none,idle,0,0\n"), std::string::npos) << headers_csv(list);
}

// Ten packets, the junk, ten packets; and each way of a recorder to put bytes before them.
TEST(Headers, SkipsAndCountsWhatIsNoPacket) {
  VERIFIES("LASSO-GND-021~2");
  for (const bool checked : {true, false}) {
    const auto stream_of = [&](const Stream& head, const Stream& before, const Stream& junk, const Stream& tail) {
      Stream stream = head;
      for (std::uint16_t count = 0; count < 20; ++count) {
        if (count == 10) add(stream, junk);
        add(stream, before);
        add(stream, sent({0x4C0, count, 0xAA, checked}));
      }
      add(stream, tail);
      return stream;
    };
    const std::string all = std::string("20 packets: CRC ") + (checked ? "right in 20, wrong in 0" : "right in 0, wrong in 0, none in 20") +
                            "; 0 gaps in the sequence, 0 packets missing; 0 restarts, 0 late, 0 repeated; ";
    EXPECT_EQ(summary_of(stream_of({}, {}, {}, {})), all + "0 bytes skipped, 0 left over\n");
    EXPECT_EQ(summary_of(stream_of({}, {}, Stream(7, 0xFF), {})), all + "7 bytes skipped, 0 left over\n");
    EXPECT_EQ(summary_of(stream_of({}, {}, Stream(13, 0), {})), all + "13 bytes skipped, 0 left over\n");
    EXPECT_EQ(summary_of(stream_of({0xDE, 0xAD, 0xBE, 0xEF, 1}, {}, {}, {})), all + "5 bytes skipped, 0 left over\n");
    EXPECT_EQ(summary_of(stream_of({}, {0, 0, 0, 20}, {}, {})), all + "80 bytes skipped (4 before each packet), 0 left over\n");
    EXPECT_EQ(summary_of(stream_of({}, {0x1A, 0xCF, 0xFC, 0x1D}, {}, {})), all + "80 bytes skipped (4 before each packet), 0 left over\n");
    EXPECT_EQ(summary_of(stream_of({'T', 'L', 'M'}, {20, 0}, {}, {})), all + "43 bytes skipped, 0 left over\n");
    EXPECT_EQ(summary_of(stream_of({}, {}, {}, Stream(500, 0))), all + "0 bytes skipped, 500 left over\n");
    EXPECT_EQ(summary_of(stream_of({}, {}, {}, Stream(100, 0xFF))), all + "0 bytes skipped, 100 left over\n");
    Stream file_header(600);  // of a recorder
    for (std::size_t i = 0; i < file_header.size(); ++i) file_header[i] = static_cast<std::uint8_t>(i * i >> 3);
    EXPECT_EQ(summary_of(stream_of(file_header, {}, {}, {})), all + "600 bytes skipped, 0 left over\n");
    const Stream whole = sent({0x4C0, 20, 0, checked});
    EXPECT_EQ(summary_of(stream_of({}, {}, {}, Stream(whole.begin(), whole.begin() + 15))), all + "0 bytes skipped, 15 left over\n");
  }
}

TEST(Headers, PacketsWithoutChecksumsAmongOthers) {
  VERIFIES("LASSO-GND-021~2");
  Stream stream;
  for (std::uint16_t count = 0; count < 10; ++count) {
    add(stream, sent({0x123, count, 0, false}));
    add(stream, sent({0x4C0, count, 0, true}));
  }
  stream[7 * 40 + 33] ^= 1;
  EXPECT_EQ(summary_of(stream).substr(0, 61), "20 packets: CRC right in 9, wrong in 1, none in 10; 0 gaps in");
}

TEST(Headers, WhatIsNoStreamHasNoPackets) {
  VERIFIES("LASSO-GND-021~2");
  const Stream version = {0x24, 0xC0, 0xC0, 0, 0, 0, 0};
  EXPECT_EQ(list_headers(view(version)).left_over, version.size());
  const Stream cut = {0x04, 0xC0, 0xC0, 0, 0, 9, 0};
  EXPECT_EQ(list_headers(view(cut)).left_over, cut.size());
  EXPECT_EQ(list_headers({}).left_over, 0U);
  test::Generator random(11);
  Stream noise(50000);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random.bits());
  EXPECT_TRUE(list_headers(view(noise)).lines.empty());
  EXPECT_TRUE(list_headers(view(Stream(50000, 0))).lines.empty());
}

// Each false header announces 65,542 bytes: a checksum over each would take 13 GB of them.
TEST(Headers, ManyFalseHeadersTakeLinearTime) {
  VERIFIES("LASSO-GND-021~2");
  Stream stream;
  add_counts(stream, from_to(0, 10));
  for (int i = 0; i < 200000; ++i) add(stream, {0x0B, 0xD1, 0xC0, static_cast<std::uint8_t>(i), 0xFF, 0xFF});
  add_counts(stream, from_to(10, 20));
  const auto begun = std::chrono::steady_clock::now();
  const HeaderList list = list_headers(view(stream));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
  EXPECT_EQ(list.lines.size(), 20U) << headers_table(list);
  EXPECT_EQ(list.lines.at(10).skipped, 1200000U);
}

}  // namespace
}  // namespace lasso::mdat
