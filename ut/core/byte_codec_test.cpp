#include "fsw/core/byte_codec.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

struct Field {
  int kind;            // 0..8: u8 u16 u32 u64 i16 i32 i64 f32 f64; 9: bytes
  std::uint64_t bits;  // the value, in its low bits
};
constexpr int kKinds = 10;
constexpr std::size_t kWidth[kKinds] = {1, 2, 4, 8, 2, 4, 8, 4, 8, 5};

template <class To, class From>
To reinterpret(From from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

std::uint8_t byte_of(std::uint64_t bits, std::size_t i) { return static_cast<std::uint8_t>((bits >> (8 * i)) & 0xFFU); }

void write(ByteWriter& writer, const Field& field) {
  const auto low32 = static_cast<std::uint32_t>(field.bits & 0xFFFFFFFFU);
  const auto low16 = static_cast<std::uint16_t>(field.bits & 0xFFFFU);
  const std::uint8_t raw[5] = {byte_of(field.bits, 4), byte_of(field.bits, 3), byte_of(field.bits, 2), byte_of(field.bits, 1),
                               byte_of(field.bits, 0)};
  switch (field.kind) {
    case 0:
      return writer.u8(byte_of(field.bits, 0));
    case 1:
      return writer.u16(low16);
    case 2:
      return writer.u32(low32);
    case 3:
      return writer.u64(field.bits);
    case 4:
      return writer.i16(static_cast<std::int16_t>(low16));
    case 5:
      return writer.i32(static_cast<std::int32_t>(low32));
    case 6:
      return writer.i64(static_cast<std::int64_t>(field.bits));
    case 7:
      return writer.f32(reinterpret<float>(low32));
    case 8:
      return writer.f64(reinterpret<double>(field.bits));
    default:
      return writer.bytes(raw);
  }
}

std::uint64_t read_raw(ByteReader& reader) {
  const ConstBytes raw = reader.bytes(5);
  std::uint64_t bits = 0;
  for (const std::uint8_t byte : raw) bits = (bits << 8) | byte;
  return bits;
}

// The bits as the reader gives them, in the low bits.
std::uint64_t read(ByteReader& reader, int kind) {
  switch (kind) {
    case 0:
      return reader.u8();
    case 1:
      return reader.u16();
    case 2:
      return reader.u32();
    case 3:
      return reader.u64();
    case 4:
      return static_cast<std::uint16_t>(reader.i16());
    case 5:
      return static_cast<std::uint32_t>(reader.i32());
    case 6:
      return static_cast<std::uint64_t>(reader.i64());
    case 7:
      return reinterpret<std::uint32_t>(reader.f32());
    case 8:
      return reinterpret<std::uint64_t>(reader.f64());
    default:
      return read_raw(reader);
  }
}

std::uint64_t masked(const Field& field) {
  const std::size_t width = kWidth[field.kind];
  return width == 8 ? field.bits : field.bits & ((std::uint64_t{1} << (8 * width)) - 1);
}

std::vector<Field> random_fields(test::Generator& generator, std::size_t n) {
  std::vector<Field> fields(n);
  for (Field& field : fields) {
    field.kind = static_cast<int>(generator.below(kKinds));
    field.bits = generator.bits();
    // A signalling NaN may be quieted in a register; all other bit patterns must survive.
    if (field.kind == 7) field.bits &= ~std::uint64_t{0x40000000};
    if (field.kind == 8) field.bits &= ~(std::uint64_t{1} << 62);
  }
  return fields;
}

std::size_t width_of(const std::vector<Field>& fields) {
  std::size_t n = 0;
  for (const Field& field : fields) n += kWidth[field.kind];
  return n;
}

TEST(ByteCodec, MostSignificantByteFirst) {
  VERIFIES("LASSO-COR-004~1");
  std::uint8_t buffer[27];
  ByteWriter writer(buffer);
  writer.u8(0x01);
  writer.u16(0x0203);
  writer.u32(0x04050607);
  writer.u64(0x08090A0B0C0D0E0F);
  writer.f32(1.0F);
  writer.f64(-2.0);
  ASSERT_TRUE(writer.ok());
  ASSERT_EQ(writer.size(), sizeof(buffer));
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(buffer[i], i + 1);
  const std::uint8_t floats[12] = {0x3F, 0x80, 0, 0, 0xC0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(std::memcmp(buffer + 15, floats, sizeof(floats)), 0);
}

TEST(ByteCodec, SignedValuesAreTwosComplement) {
  VERIFIES("LASSO-COR-004~1");
  std::uint8_t buffer[14];
  ByteWriter writer(buffer);
  writer.i16(std::numeric_limits<std::int16_t>::min());
  writer.i32(-2);
  writer.i64(std::numeric_limits<std::int64_t>::min() + 1);
  const std::uint8_t expected[14] = {0x80, 0, 0xFF, 0xFF, 0xFF, 0xFE, 0x80, 0, 0, 0, 0, 0, 0, 1};
  EXPECT_EQ(std::memcmp(buffer, expected, sizeof(expected)), 0);
  ByteReader reader(writer.written());
  EXPECT_EQ(reader.i16(), std::numeric_limits<std::int16_t>::min());
  EXPECT_EQ(reader.i32(), -2);
  EXPECT_EQ(reader.i64(), std::numeric_limits<std::int64_t>::min() + 1);
  EXPECT_EQ(reader.remaining(), 0U);
}

TEST(ByteCodec, RandomFieldsSurviveTheRoundTrip) {
  VERIFIES("LASSO-COR-004~1");
  test::Generator generator(11);
  for (int trial = 0; trial < 200; ++trial) {
    const auto fields = random_fields(generator, 50);
    std::vector<std::uint8_t> buffer(width_of(fields));
    ByteWriter writer(Bytes(buffer.data(), buffer.size()));
    for (const Field& field : fields) write(writer, field);
    ASSERT_TRUE(writer.ok());
    ASSERT_EQ(writer.size(), buffer.size());
    ByteReader reader(writer.written());
    for (const Field& field : fields) ASSERT_EQ(read(reader, field.kind), masked(field)) << field.kind;
    ASSERT_TRUE(reader.ok());
    ASSERT_EQ(reader.position(), buffer.size());
  }
}

// Reads fields from the first `length` bytes: right values up to the cut, zeros and a sticky failure after it.
void expect_truncated_read(const std::vector<Field>& fields, const std::vector<std::uint8_t>& image, std::size_t length) {
  const std::vector<std::uint8_t> part(image.begin(), image.begin() + static_cast<std::ptrdiff_t>(length));  // so a sanitizer sees overruns
  ByteReader reader(ConstBytes(part.data(), part.size()));
  std::size_t end = 0;
  bool fits = true;
  for (const Field& field : fields) {
    end += kWidth[field.kind];
    fits = fits && end <= length;
    ASSERT_EQ(read(reader, field.kind), fits ? masked(field) : 0U);
    ASSERT_EQ(reader.ok(), fits);
    ASSERT_LE(reader.position(), length);
  }
}

TEST(ByteCodec, EveryTruncationOfInputIsReported) {
  VERIFIES("LASSO-COR-005~1");
  test::Generator generator(12);
  for (int trial = 0; trial < 20; ++trial) {
    const auto fields = random_fields(generator, 30);
    std::vector<std::uint8_t> image(width_of(fields));
    ByteWriter writer(Bytes(image.data(), image.size()));
    for (const Field& field : fields) write(writer, field);
    for (std::size_t length = 0; length <= image.size(); ++length) expect_truncated_read(fields, image, length);
  }
}

TEST(ByteCodec, WritingPastTheEndTouchesNothingAndSticks) {
  VERIFIES("LASSO-COR-005~1");
  test::Generator generator(13);
  const auto fields = random_fields(generator, 30);
  const std::size_t total = width_of(fields);
  constexpr std::uint8_t kGuard = 0xA5;
  for (std::size_t room = 0; room < total; ++room) {
    std::vector<std::uint8_t> memory(total + 16, kGuard);
    ByteWriter writer(Bytes(memory.data(), room));
    std::size_t fitting = 0;
    std::size_t end = 0;
    for (const Field& field : fields) {
      write(writer, field);
      end += kWidth[field.kind];
      if (writer.ok()) fitting = end;
    }
    ASSERT_FALSE(writer.ok());
    ASSERT_EQ(writer.size(), fitting);
    ASSERT_LE(fitting, room);
    for (std::size_t i = fitting; i < memory.size(); ++i) ASSERT_EQ(memory[i], kGuard);
  }
}

TEST(ByteCodec, ALaterShorterFieldDoesNotHideAFailure) {
  VERIFIES("LASSO-COR-005~1");
  std::uint8_t buffer[3] = {1, 2, 3};
  ByteReader reader(ConstBytes(buffer, 3));
  EXPECT_EQ(reader.u32(), 0U);
  EXPECT_EQ(reader.u8(), 0U);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.remaining(), 3U);
  EXPECT_TRUE(ByteReader(ConstBytes(buffer, 3)).bytes(4).empty());
  ByteWriter writer(buffer);
  writer.u32(7);
  writer.u8(9);
  EXPECT_FALSE(writer.ok());
  EXPECT_EQ(writer.size(), 0U);
  EXPECT_EQ(buffer[0], 1);
}

TEST(ByteCodec, EachKindEndsWithTheBuffer) {
  VERIFIES("LASSO-COR-005~1");
  const std::uint8_t buffer[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  const auto of = [&](std::size_t bytes) { return ByteReader(ConstBytes(buffer, bytes)); };
  EXPECT_EQ(of(1).u8(), 1U);
  EXPECT_EQ(of(0).u8(), 0U);
  EXPECT_EQ(of(2).u16(), 0x0102U);
  EXPECT_EQ(of(1).u16(), 0U);
  EXPECT_EQ(of(4).u32(), 0x01020304U);
  EXPECT_EQ(of(3).u32(), 0U);
  EXPECT_EQ(of(8).u64(), 0x0102030405060708U);
  EXPECT_EQ(of(7).u64(), 0U);
}

TEST(ByteCodec, HugeLengthsDoNotWrapAround) {
  VERIFIES("LASSO-COR-005~1");
  const std::uint8_t buffer[4] = {1, 2, 3, 4};
  ByteReader reader{ConstBytes(buffer)};
  EXPECT_EQ(reader.u8(), 1);
  EXPECT_TRUE(reader.bytes(std::numeric_limits<std::size_t>::max()).empty());
  EXPECT_FALSE(reader.ok());
}

TEST(ByteCodec, NothingIsWrittenOrReadForEmptySpans) {
  VERIFIES("LASSO-COR-004~1");
  ByteWriter writer{Bytes()};
  writer.bytes({});
  EXPECT_TRUE(writer.ok());
  ByteReader reader{ConstBytes()};
  EXPECT_TRUE(reader.bytes(0).empty());
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.remaining(), 0U);
}

}  // namespace
}  // namespace lasso
