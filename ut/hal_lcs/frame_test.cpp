#include "hal_lcs/frame.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hal_lcs/byte_ring.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

using Octets = std::vector<std::uint8_t>;

Octets octets(const FrameBytes& frame) { return {frame.bytes, frame.bytes + frame.size}; }

Octets random_octets(test::Generator& chance, std::size_t size) {
  Octets all(size);
  for (std::uint8_t& octet : all) octet = static_cast<std::uint8_t>(chance.bits());
  return all;
}

struct Sent {
  std::uint8_t type, sequence;
  Octets payload;
};

Sent random_frame(test::Generator& chance) {
  return {static_cast<std::uint8_t>(chance.bits()), static_cast<std::uint8_t>(chance.bits()),
          random_octets(chance, chance.bits() % (kMaxPayload + 1))};
}

void append(Octets& stream, const Octets& more) { stream.insert(stream.end(), more.begin(), more.end()); }

Octets bytes_of(const Sent& sent) {
  return octets(encode_frame(sent.type, sent.sequence, ConstBytes(sent.payload.data(), sent.payload.size())));
}

// All frames in the stream, which comes in pieces of any size.
std::vector<Sent> decode_all(FrameDecoder& decoder, const Octets& stream, test::Generator& chance, std::size_t most = 100) {
  std::vector<Sent> found;
  std::size_t at = 0;
  Frame frame;
  while (at < stream.size()) {
    const std::size_t piece = std::min<std::size_t>(1 + chance.bits() % most, stream.size() - at);
    std::size_t end = at + piece;
    for (;;) {
      const FrameDecoder::Step step = decoder.step(ConstBytes(stream.data() + at, end - at), frame);
      at += step.taken;
      if (!step.found) break;
      found.push_back({frame.type, frame.sequence, Octets(frame.payload, frame.payload + frame.length)});
    }
    EXPECT_EQ(at, end);
  }
  return found;
}

bool same(const Sent& a, const Sent& b) { return a.type == b.type && a.sequence == b.sequence && a.payload == b.payload; }

TEST(LcsFrame, HasTheDocumentedBytes) {
  VERIFIES("LASSO-LCS-002~1");
  const std::uint8_t payload[] = {0x01, 0xFE};
  // The checksum of 02 91 07 01 FE by another program (binascii.crc_hqx with 0xFFFF).
  EXPECT_EQ(octets(encode_frame(0x91, 7, ConstBytes(payload))), (Octets{0x5A, 0xC3, 0x02, 0x91, 0x07, 0x01, 0xFE, 0x5D, 0xD4}));
  EXPECT_EQ(encode_frame(0, 0, ConstBytes()).size, kFrameOverhead);
  EXPECT_EQ(kMaxFrame, 64U);
}

TEST(LcsFrame, ComesBackWhateverThePieces) {
  VERIFIES("LASSO-LCS-002~1");
  test::Generator chance(4711);
  std::vector<Sent> sent;
  Octets stream;
  for (int i = 0; i < 200; ++i) {
    sent.push_back(random_frame(chance));
    append(stream, bytes_of(sent.back()));
  }
  FrameDecoder decoder;
  const std::vector<Sent> found = decode_all(decoder, stream, chance);
  ASSERT_EQ(found.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_TRUE(same(found[i], sent[i])) << i;
  EXPECT_EQ(decoder.counters().frames, sent.size());
  EXPECT_EQ(decoder.counters().skipped + decoder.counters().bad_crc + decoder.counters().bad_length, 0U);
}

// Frames, parts of frames and garbage: byte by byte as in any pieces.
TEST(LcsFrame, DoesNotDependOnThePieces) {
  VERIFIES("LASSO-LCS-002~1 LASSO-LCS-014~2");
  test::Generator chance(99);
  for (int round = 0; round < 300; ++round) {
    Octets stream;
    for (int i = 0; i < 12; ++i) {
      Octets next = chance.bits() % 4 == 0 ? random_octets(chance, chance.bits() % 20) : bytes_of(random_frame(chance));
      if (chance.bits() % 3 == 0) next.resize(chance.bits() % (next.size() + 1));
      append(stream, next);
    }
    FrameDecoder in_pieces, in_bytes;
    const std::vector<Sent> found = decode_all(in_pieces, stream, chance);
    const std::vector<Sent> expected = decode_all(in_bytes, stream, chance, 1);
    ASSERT_EQ(found.size(), expected.size()) << round;
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_TRUE(same(found[i], expected[i])) << round << ' ' << i;
    ASSERT_EQ(in_pieces.counters().skipped, in_bytes.counters().skipped) << round;
    ASSERT_EQ(in_pieces.counters().bad_crc, in_bytes.counters().bad_crc) << round;
    ASSERT_EQ(in_pieces.counters().bad_length, in_bytes.counters().bad_length) << round;
  }
}

TEST(LcsFrame, IsFoundBehindGarbage) {
  VERIFIES("LASSO-LCS-002~1");
  test::Generator chance(42);
  const Octets traps[] = {{0x5A},       {0x5A, 0x5A}, {0x5A, 0xC3}, {0x5A, 0xC3, 57}, {0x5A, 0xC3, 58}, {0x5A, 0xC3, 0xFF, 0x00},
                          {0x5A, 0x00}, {0xC3}};
  for (int round = 0; round < 200; ++round) {
    const Sent sent = random_frame(chance);
    Octets stream = random_octets(chance, chance.bits() % 80);
    append(stream, traps[chance.bits() % 8]);
    append(stream, bytes_of(sent));
    append(stream, Octets(kMaxFrame, 0));  // what a false beginning still waits for
    FrameDecoder decoder;
    const std::vector<Sent> found = decode_all(decoder, stream, chance);
    ASSERT_EQ(found.size(), 1U) << round;
    EXPECT_TRUE(same(found[0], sent)) << round;
    EXPECT_EQ(decoder.counters().skipped + sent.payload.size() + kFrameOverhead, stream.size());
  }
}

TEST(LcsFrame, EachSingleBitErrorCostsThatFrameAlone) {
  VERIFIES("LASSO-LCS-002~1 LASSO-LCS-014~2");
  test::Generator chance(5);
  const Sent first{0x91, 1, random_octets(chance, 55)}, second{0x91, 2, random_octets(chance, 55)};
  for (std::size_t bit = 0; bit < 8 * (55 + kFrameOverhead); ++bit) {
    Octets stream = bytes_of(first);
    stream[bit / 8] = static_cast<std::uint8_t>(stream[bit / 8] ^ (1U << (bit % 8)));
    append(stream, bytes_of(second));
    append(stream, Octets(kMaxFrame, 0));
    FrameDecoder decoder;
    const std::vector<Sent> found = decode_all(decoder, stream, chance);
    ASSERT_EQ(found.size(), 1U) << bit;
    EXPECT_TRUE(same(found[0], second)) << bit;
    EXPECT_GT(decoder.counters().skipped, 0U);
  }
}

TEST(LcsFrame, CountsWhatWasWrong) {
  VERIFIES("LASSO-LCS-014~2");
  FrameDecoder decoder;
  Frame frame;
  const std::uint8_t long_one[] = {0x5A, 0xC3, 58};
  EXPECT_FALSE(decoder.step(ConstBytes(long_one), frame).found);
  EXPECT_EQ(decoder.counters().bad_length, 1U);
  Octets damaged = octets(encode_frame(1, 2, ConstBytes()));
  damaged[5] ^= 1;
  EXPECT_FALSE(decoder.step(ConstBytes(damaged.data(), damaged.size()), frame).found);
  EXPECT_EQ(decoder.counters().bad_crc, 1U);
  EXPECT_EQ(decoder.counters().frames, 0U);
}

TEST(LcsFrame, ForgetsOnlyItsBytesWhenCleared) {
  FrameDecoder decoder;
  Frame frame;
  const Octets whole = octets(encode_frame(1, 2, ConstBytes()));
  EXPECT_FALSE(decoder.step(ConstBytes(whole.data(), 3), frame).found);
  decoder.clear();
  EXPECT_FALSE(decoder.step(ConstBytes(whole.data() + 3, whole.size() - 3), frame).found);
  EXPECT_TRUE(decoder.step(ConstBytes(whole.data(), whole.size()), frame).found);
}

TEST(LcsFrameDeath, PayloadTooLongForAFrame) {
  const std::uint8_t payload[kMaxPayload + 1] = {};
  EXPECT_DEATH(encode_frame(0, 0, ConstBytes(payload)), "lcs payload");
}

TEST(ByteRing, KeepsTheOrderAndRefusesWhatDoesNotFit) {
  ByteRing<8> ring;
  const std::uint8_t six[] = {1, 2, 3, 4, 5, 6};
  std::uint8_t out[8] = {};
  for (int round = 0; round < 20; ++round) {  // wraps
    EXPECT_EQ(ring.room(), 8U);
    EXPECT_EQ(ring.write(ConstBytes(six)), 6U);
    EXPECT_EQ(ring.write(ConstBytes(six)), 2U);
    EXPECT_EQ(ring.room(), 0U);
    EXPECT_EQ(ring.read(Bytes(out, 5)), 5U);
    EXPECT_EQ(Octets(out, out + 5), (Octets{1, 2, 3, 4, 5}));
    EXPECT_EQ(ring.read(Bytes(out)), 3U);
    EXPECT_EQ(Octets(out, out + 3), (Octets{6, 1, 2}));
    EXPECT_EQ(ring.read(Bytes(out)), 0U);
  }
}

}  // namespace
}  // namespace lasso::lcs
