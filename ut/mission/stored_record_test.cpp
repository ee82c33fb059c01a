#include "fsw/mission/stored_record.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fsw/core/crc.hpp"
#include "ut/support/ram_store.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr StoreArea kA = StoreArea::kParameters0, kB = StoreArea::kParameters1;

std::vector<std::uint8_t> record(std::uint8_t seed) {
  std::vector<std::uint8_t> bytes(300);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(seed + 7 * i);
  return bytes;
}
ConstBytes view(const std::vector<std::uint8_t>& bytes) { return {bytes.data(), bytes.size()}; }
Status save(Store& store, std::uint8_t seed) { return save_record(store, kA, kB, view(record(seed))); }
std::vector<std::uint8_t> load(Store& store) {
  std::vector<std::uint8_t> bytes(300);
  if (load_record(store, kA, kB, Bytes(bytes.data(), bytes.size())) != Status::kOk) bytes.clear();
  return bytes;
}

// What cannot be read is not what counts: the one that is right stays.
TEST(StoredRecord, TheOneThatIsRightIsNotReplaced) {
  VERIFIES("LASSO-IMG-015~1");
  test::RamStore store(64);
  ASSERT_EQ(save(store, 1), Status::kOk);
  ASSERT_EQ(save(store, 2), Status::kOk);
  const StoreArea newer = newer_of(store, kA, kB) == Newer::kFirst ? kA : kB;
  store.of(newer)[kStoredHeaderBytes + 100] ^= 1U;
  EXPECT_EQ(load(store), record(1));
  store.bytes_left = kStoredHeaderBytes + 10;  // the power fails while the next one is written
  static_cast<void>(save(store, 3));
  store.bytes_left = test::RamStore::kForEver;
  EXPECT_EQ(load(store), record(1));
  ASSERT_EQ(save(store, 4), Status::kOk);
  EXPECT_EQ(load(store), record(4));
}

// Whichever area the newer record is in: when it is spoiled, the one before it is loaded.
TEST(StoredRecord, ASpoiledOneGivesWayToTheOneBefore) {
  VERIFIES("LASSO-IMG-015~1");
  for (const std::uint8_t saved : {std::uint8_t{2}, std::uint8_t{3}}) {
    test::RamStore store(64);
    for (std::uint8_t seed = 1; seed <= saved; ++seed) ASSERT_EQ(save(store, seed), Status::kOk);
    const StoreArea newer = newer_of(store, kA, kB) == Newer::kFirst ? kA : kB;
    store.of(newer)[kStoredHeaderBytes + 100] ^= 1U;
    EXPECT_EQ(load(store), record(static_cast<std::uint8_t>(saved - 1)));
  }
}

// A header without a number is one of which the record was never finished, whatever its sum.
TEST(StoredRecord, OneWithoutANumberIsReplaced) {
  VERIFIES("LASSO-IMG-015~1");
  for (const StoreArea area : {kA, kB}) {
    test::RamStore store(64);
    ASSERT_EQ(write_header(store, area, StoredHeader{}), Status::kOk);
    ASSERT_EQ(save(store, 1), Status::kOk);
    EXPECT_EQ(newer_of(store, kA, kB), Newer::kSecond) << "as in an empty store";
    EXPECT_EQ(load(store), record(1));
  }
}

// A medium that cannot be read from some look at it on: nothing is replaced where nobody knows what is there, and nothing is said to be
// saved that was not read back.
TEST(StoredRecord, WhatIsSaidToBeSavedIsLoaded) {
  VERIFIES("LASSO-IMG-015~1");
  constexpr std::size_t kReads = 15;  // of a save
  for (std::size_t reads = 0; reads <= kReads; ++reads) {
    test::RamStore store(64);
    ASSERT_EQ(save(store, 1), Status::kOk);
    ASSERT_EQ(save(store, 2), Status::kOk);
    store.reads_left = reads;
    EXPECT_EQ(save(store, 3) == Status::kOk, reads == kReads) << reads;
    store.reads_left = test::RamStore::kForEver;
    EXPECT_FALSE(load(store).empty()) << reads;
    if (reads < 2) {
      EXPECT_EQ(load(store), record(2)) << reads;
    }
  }
}

TEST(StoredRecord, AreasThatAreTooSmallTakeNothing) {
  VERIFIES("LASSO-IMG-015~1");
  for (const std::size_t bytes : {std::size_t{8}, kStoredHeaderBytes + 8}) {
    test::RamStore store(64);
    for (const StoreArea area : {kA, kB}) store.of(area).resize(bytes);
    EXPECT_NE(save(store, 1), Status::kOk);
    EXPECT_TRUE(load(store).empty());
  }
}

TEST(StoredRecord, TheNewerOneCounts) {
  VERIFIES("LASSO-IMG-015~1");
  test::RamStore store(64);
  EXPECT_EQ(newer_of(store, kA, kB), Newer::kNone);
  EXPECT_TRUE(load(store).empty());
  for (std::uint8_t seed = 1; seed < 6; ++seed) {
    ASSERT_EQ(save(store, seed), Status::kOk);
    EXPECT_EQ(load(store), record(seed));
  }
  EXPECT_NE(newer_of(store, kA, kB), Newer::kNone);
}

// The header byte by byte.
TEST(StoredRecord, IsHeadedAsDescribed) {
  VERIFIES("LASSO-IMG-015~1");
  test::RamStore store(64);
  ASSERT_EQ(write_header(store, kA, {0x01020304, 300, 0x0A0B0C0D}), Status::kOk);
  const std::uint8_t expected[] = {0x33, 0x4C, 0x53, 0x54, 1, 2, 3, 4, 0, 0, 1, 0x2C, 0x0A, 0x0B, 0x0C, 0x0D};
  for (std::size_t i = 0; i < sizeof expected; ++i) EXPECT_EQ(store.of(kA)[i], expected[i]) << i;
  const std::uint32_t sum = crc32c(ConstBytes(expected));
  EXPECT_EQ(store.of(kA)[16], sum >> 24);
  EXPECT_EQ(store.of(kA)[19], sum & 0xFF);
  StoredHeader header;
  ASSERT_EQ(read_header(store, kA, header), Status::kOk);
  EXPECT_EQ(header.sequence, 0x01020304U);
  EXPECT_EQ(header.crc, 0x0A0B0C0DU);
  ASSERT_EQ(clear_header(store, kA), Status::kOk);
  EXPECT_EQ(read_header(store, kA, header), Status::kNoData);
}

// Power fails behind each byte of the writing: what is loaded then is the old record or the new one, and the old one until the last byte.
TEST(StoredRecord, APowerLossAnywhereLeavesTheOldOneOrTheNewOne) {
  VERIFIES("LASSO-IMG-015~1");
  test::RamStore before(64);
  ASSERT_EQ(save(before, 1), Status::kOk);
  ASSERT_EQ(save(before, 2), Status::kOk);
  test::RamStore whole = before;
  whole.written = 0;
  ASSERT_EQ(save(whole, 3), Status::kOk);
  for (std::size_t cut = 1; cut <= whole.written; ++cut) {
    test::RamStore store = before;
    store.bytes_left = cut;
    static_cast<void>(save(store, 3));
    store.bytes_left = test::RamStore::kForEver;
    const std::vector<std::uint8_t> loaded = load(store);
    const bool header_whole = cut > whole.written - (kStoredHeaderBytes - 20);  // its last bytes say nothing
    EXPECT_EQ(loaded, record(header_whole ? 3 : 2)) << cut;
    ASSERT_EQ(save(store, 4), Status::kOk);  // and the next one is taken
    EXPECT_EQ(load(store), record(4)) << cut;
  }
}

TEST(StoredRecord, AnyFlippedBitLeavesTheOneBefore) {
  VERIFIES("LASSO-IMG-015~1");
  test::RamStore before(64);
  ASSERT_EQ(save(before, 1), Status::kOk);
  ASSERT_EQ(save(before, 2), Status::kOk);
  const StoreArea newer = newer_of(before, kA, kB) == Newer::kFirst ? kA : kB;
  for (std::size_t bit = 0; bit < 8 * (kStoredHeaderBytes + 300); ++bit) {
    if (bit / 8 >= 20 && bit / 8 < kStoredHeaderBytes) continue;  // of no meaning
    test::RamStore store = before;
    store.of(newer)[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_EQ(load(store), record(1)) << bit;
  }
}

TEST(StoredRecord, NumbersWrap) {
  VERIFIES("LASSO-IMG-015~1");
  test::RamStore store(64);
  const std::uint32_t sum = crc32c(view(record(9)));
  ASSERT_EQ(write_header(store, kA, {0xFFFFFFFFU, 300, sum}), Status::kOk);
  ASSERT_EQ(write_record(store, kA, 0, view(record(9))), Status::kOk);
  EXPECT_EQ(next_sequence(store, kA, kB), 1U);  // 0 says: never selected
  ASSERT_EQ(save(store, 10), Status::kOk);
  EXPECT_EQ(newer_of(store, kA, kB), Newer::kSecond);
  EXPECT_EQ(load(store), record(10));
  ASSERT_EQ(write_header(store, kA, {2, 300, sum}), Status::kOk);
  EXPECT_EQ(load(store), record(9));
  ASSERT_EQ(write_header(store, kA, {0, 300, sum}), Status::kOk);
  EXPECT_EQ(load(store), record(10));
  ASSERT_EQ(clear_header(store, kB), Status::kOk);
  EXPECT_TRUE(load(store).empty());
}

TEST(StoredRecord, WhatCannotBeReadOrWrittenIsSaid) {
  VERIFIES("LASSO-IMG-015~1");
  test::RamStore store(16);
  StoredHeader header;
  EXPECT_EQ(read_header(store, StoreArea::kImage0, header), Status::kNoData);  // smaller than a header
  ASSERT_EQ(write_header(store, kA, {1, 100000, 0}), Status::kOk);
  EXPECT_EQ(read_header(store, kA, header), Status::kNoData);  // longer than the area
  ASSERT_EQ(write_header(store, kA, {1, 10, 0}), Status::kOk);
  EXPECT_TRUE(load(store).empty());  // of another length
  ASSERT_EQ(save(store, 1), Status::kOk);
  store.broken = true;
  EXPECT_EQ(save(store, 2), Status::kNoData);
  EXPECT_TRUE(load(store).empty());
  store.broken = false;
  EXPECT_EQ(load(store), record(1));
  const std::vector<std::uint8_t> long_one(5000);
  EXPECT_EQ(save_record(store, kA, kB, view(long_one)), Status::kBadIndex);
  EXPECT_EQ(load(store), record(1));
}

// Both images with their headers, parameter sets of 1,000 values with theirs, a thousand events of 64 bytes.
TEST(StoredRecord, EachAreaHasRoomForWhatItHolds) {
  VERIFIES("LASSO-IMG-015~1");
  for (const std::size_t image_bytes : {std::size_t{4096}, std::size_t{31} << 20}) {
    for (const StoreArea area : {StoreArea::kImage0, StoreArea::kImage1}) {
      EXPECT_EQ(stored_area_bytes(area, image_bytes), image_bytes + kStoredHeaderBytes);
    }
    for (const StoreArea area : {StoreArea::kParameters0, StoreArea::kParameters1}) {
      EXPECT_GE(stored_area_bytes(area, image_bytes), kStoredHeaderBytes + 1000 * sizeof(double));
    }
    EXPECT_GE(stored_area_bytes(StoreArea::kEventLog, image_bytes), 1000U * 64);
  }
}

}  // namespace
}  // namespace lasso
