#include "bsp/bare/ram_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::bare {
namespace {

using Octets = std::vector<std::uint8_t>;
constexpr std::size_t kImageBytes = 10000;
constexpr StoreArea kAreas[] = {StoreArea::kImage0, StoreArea::kImage1, StoreArea::kParameters0, StoreArea::kParameters1,
                                StoreArea::kEventLog};

Octets noise(std::size_t bytes, std::uint64_t seed) {
  test::Generator chance(seed);
  Octets all(bytes);
  for (std::uint8_t& octet : all) octet = static_cast<std::uint8_t>(chance.bits());
  return all;
}

ConstBytes view(const Octets& octets) { return {octets.data(), octets.size()}; }

// Memory that outlives stores over it, as over a restart.
class RamStoreTest : public ::testing::Test {
 protected:
  RamStoreTest() : memory_(noise(RamStore::region_bytes(kImageBytes), 1)) {
    written_back_ = 0;
    last_ = ConstBytes();
  }
  RamStore store() { return {Bytes(memory_.data(), memory_.size()), kImageBytes, note}; }
  static void note(ConstBytes written) {
    written_back_ += written.size();
    last_ = written;
  }
  static Octets read(RamStore& store, StoreArea area, std::size_t offset, std::size_t bytes) {
    Octets out(bytes);
    EXPECT_EQ(store.read(area, offset, Bytes(out.data(), out.size())), Status::kOk);
    return out;
  }

  Octets memory_;
  static inline std::size_t written_back_ = 0;
  static inline ConstBytes last_;
};

// Of a record that is saved anew a prefix is written, as by a restart in the middle.
class CutStore final : public Store {
 public:
  CutStore(RamStore& store, std::size_t bytes) : store_(store), left_(bytes) {}
  std::size_t size(StoreArea area) const override { return store_.size(area); }
  Status read(StoreArea area, std::size_t offset, Bytes out) override { return store_.read(area, offset, out); }
  Status write(StoreArea area, std::size_t offset, ConstBytes data) override {
    const std::size_t now = std::min(data.size(), left_);
    left_ -= now;
    EXPECT_EQ(store_.write(area, offset, data.first(now)), Status::kOk);
    return Status::kOk;
  }
  bool cut() const { return left_ == 0; }

 private:
  RamStore& store_;
  std::size_t left_;
};

TEST_F(RamStoreTest, KeepsWhatWasWrittenOverARestart) {
  VERIFIES("LASSO-IMG-015~1");
  const Octets data = noise(100, 2);
  {
    RamStore before = store();
    for (const StoreArea area : kAreas) {
      const Octets own = noise(100, static_cast<std::uint64_t>(area));
      ASSERT_EQ(before.write(area, 0, view(data)), Status::kOk);
      ASSERT_EQ(before.write(area, before.size(area) - own.size(), view(own)), Status::kOk);
    }
  }
  RamStore after = store();
  for (const StoreArea area : kAreas) {
    EXPECT_EQ(read(after, area, 0, 100), data);
    EXPECT_EQ(read(after, area, after.size(area) - 100, 100), noise(100, static_cast<std::uint64_t>(area)));
  }
}

TEST_F(RamStoreTest, HasAreasAsLargeAsTheFilesOfLinux) {
  VERIFIES("LASSO-IMG-015~1");
  const RamStore here = store();
  for (const StoreArea area : kAreas) EXPECT_EQ(here.size(area), stored_area_bytes(area, kImageBytes));
  EXPECT_EQ(RamStore::region_bytes(kImageBytes), 2 * (kImageBytes + kStoredHeaderBytes) + 2 * 16384 + 65536);
}

// Each byte belongs to one area, and a write changes no other.
TEST_F(RamStoreTest, TouchesNothingBesideAWrite) {
  VERIFIES("LASSO-IMG-015~1");
  test::Generator chance(3);
  RamStore here = store();
  for (int i = 0; i < 500; ++i) {
    const StoreArea area = kAreas[chance.bits() % 5];
    const Octets data = noise(chance.bits() % kMaxStoreWriteBytes, static_cast<std::uint64_t>(i));
    const std::size_t offset = chance.bits() % (here.size(area) - data.size() + 1);
    const Octets before = memory_;
    ASSERT_EQ(here.write(area, offset, view(data)), Status::kOk);
    ASSERT_EQ(read(here, area, offset, data.size()), data);
    const std::size_t changed_from =
        static_cast<std::size_t>(std::mismatch(before.begin(), before.end(), memory_.begin()).first - before.begin());
    const auto begin = static_cast<std::size_t>(last_.data() - memory_.data());
    ASSERT_TRUE(changed_from == memory_.size() || changed_from >= begin);
    ASSERT_TRUE(std::equal(before.begin() + static_cast<std::ptrdiff_t>(begin + data.size()), before.end(),
                           memory_.begin() + static_cast<std::ptrdiff_t>(begin + data.size())));
  }
}

TEST_F(RamStoreTest, RefusesWhatIsOutsideOfAnArea) {
  VERIFIES("LASSO-IMG-015~1");
  RamStore here = store();
  const Octets before = memory_;
  Octets bytes(64);
  for (const StoreArea area : kAreas) {
    for (const std::size_t offset : {here.size(area) - 63, here.size(area) + 1, ~std::size_t{0}, ~std::size_t{0} - 63}) {
      EXPECT_EQ(here.write(area, offset, view(bytes)), Status::kBadIndex);
      EXPECT_EQ(here.read(area, offset, Bytes(bytes.data(), bytes.size())), Status::kBadIndex);
    }
    EXPECT_EQ(here.write(area, here.size(area) - 64, view(bytes)), Status::kOk);
  }
  memory_ = before;
  EXPECT_EQ(here.write(StoreArea::kImage0, 0, view(Octets(kMaxStoreWriteBytes + 1))), Status::kBadIndex);
  EXPECT_EQ(memory_, before);
}

TEST_F(RamStoreTest, WritesBackWhatItWrites) {
  VERIFIES("LASSO-IMG-015~1");
  RamStore here = store();
  const Octets data = noise(777, 4);
  ASSERT_EQ(here.write(StoreArea::kImage1, 5, view(data)), Status::kOk);
  EXPECT_EQ(written_back_, 777U);
  EXPECT_TRUE(std::equal(data.begin(), data.end(), last_.begin()));
  read(here, StoreArea::kImage1, 5, 777);
  EXPECT_EQ(written_back_, 777U);
}

// Noise, all zeros, all ones: what memory may hold when power comes.
TEST_F(RamStoreTest, FreshMemoryReadsAsNothing) {
  VERIFIES("LASSO-IMG-015~1");
  for (int kind = 0; kind < 20; ++kind) {
    if (kind >= 2) memory_ = noise(memory_.size(), static_cast<std::uint64_t>(kind));
    if (kind < 2) std::fill(memory_.begin(), memory_.end(), static_cast<std::uint8_t>(kind * 0xFF));
    RamStore here = store();
    Octets out(100);
    EXPECT_EQ(newer_of(here, StoreArea::kImage0, StoreArea::kImage1), Newer::kNone);
    EXPECT_EQ(load_record(here, StoreArea::kParameters0, StoreArea::kParameters1, Bytes(out.data(), out.size())), Status::kNoData);
  }
}

// At every byte that a save writes.
TEST_F(RamStoreTest, ARestartInTheMiddleOfASaveLeavesTheOldSet) {
  VERIFIES("LASSO-IMG-015~1");
  const Octets first = noise(100, 5), second = noise(100, 6);
  RamStore here = store();
  ASSERT_EQ(save_record(here, StoreArea::kParameters0, StoreArea::kParameters1, view(first)), Status::kOk);
  const Octets saved = memory_;
  bool whole = false;
  for (std::size_t bytes = 0; !whole; ++bytes) {
    memory_ = saved;
    CutStore cut(here, bytes);
    static_cast<void>(save_record(cut, StoreArea::kParameters0, StoreArea::kParameters1, view(second)));
    whole = !cut.cut();
    Octets out(100);
    ASSERT_EQ(load_record(here, StoreArea::kParameters0, StoreArea::kParameters1, Bytes(out.data(), out.size())), Status::kOk) << bytes;
    ASSERT_TRUE(out == first || (out == second && bytes >= 100 + 2 * 20)) << bytes;
    ASSERT_TRUE(!whole || out == second);
  }
}

TEST_F(RamStoreTest, NeedsMemoryForAllOfIt) {
  VERIFIES("LASSO-IMG-015~1");
  EXPECT_DEATH(RamStore(Bytes(memory_.data(), memory_.size() - 1), kImageBytes, note), "a store larger than its memory");
}

}  // namespace
}  // namespace lasso::bare
