#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "cfg/capacities.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/mission/image_format.hpp"
#include "fsw/mission/mission.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/path_numbers.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::TestImage;

class LoaderTest : public ::testing::Test {
 protected:
  static const TestImage& whole_image() {
    static const TestImage image = test::make_box_image(preset_parameters());
    return image;
  }

  TestImage image_ = whole_image();
  std::unique_ptr<Mission> mission_ = std::make_unique<Mission>();

  LoadFailure load() { return load_image(Bytes(image_.data(), image_.size), *mission_); }
  void put(std::size_t offset, std::uint32_t word) {
    for (std::size_t i = 0; i < 4; ++i) image_.data()[offset + i] = static_cast<std::uint8_t>(word >> (24 - 8 * i));
  }
  // Changes one word of a table, with checksums made good again: what is left is for the validation to find.
  void spoil(TableId id, std::size_t word, std::uint32_t value) {
    put(test::table_offset(image_, static_cast<std::uint32_t>(id)) + 4 * word, value);
    test::repair_crcs(image_);
  }
  // The same with a word of the table's entry in the directory: 0 id, 1 words per record, 2 records, 3 offset.
  void spoil_directory(TableId id, std::size_t word, std::uint32_t value) {
    put(4 * (kImageHeaderWords + kDirectoryEntryWords * (static_cast<std::size_t>(id) - 1) + word), value);
    test::repair_crcs(image_);
  }
  // The load fails with `status`, and neither image nor mission has changed.
  void expect_refused(Status status) {
    const TestImage before = image_;
    mission_->id = 4711;
    const LoadFailure result = load();
    EXPECT_EQ(result.status, status) << result.what;
    EXPECT_STRNE(result.what, "");
    EXPECT_EQ(mission_->id, 4711u);
    EXPECT_EQ(image_.storage, before.storage);
  }
};

TEST_F(LoaderTest, LoadsAValidImage) {
  VERIFIES("LASSO-IMG-001~1 LASSO-SYS-024~1");
  ASSERT_EQ(load().status, Status::kOk);
  EXPECT_EQ(mission_->id, 7u);
  EXPECT_EQ(mission_->version, 3u);
  EXPECT_EQ(mission_->field.element_count, 6u);
  EXPECT_EQ(mission_->edges.size(), 12u);
  EXPECT_EQ(mission_->hull.size(), 8u);
  EXPECT_EQ(mission_->search.views.size(), 162u);
  EXPECT_EQ(mission_->search.symmetries.size(), 3u);
  EXPECT_NEAR(mission_->search.size_m, 0.6F, 1e-6F);
  EXPECT_NEAR(mission_->search.truncation_m, 0.06F, 1e-6F);
  EXPECT_TRUE(test::is_path_number(mission_->search.symmetries[1].q[1], 1)) << "about y, by a quaternion with its scalar last";
  EXPECT_NEAR(mission_->center_m[1], -0.01, 1e-7);
  EXPECT_NEAR(mission_->radius_m, Vec3(0.32, 0.21, 0.15).norm(), 1e-6);
  EXPECT_DOUBLE_EQ(mission_->parameters.duration_s, preset_parameters().duration_s);
  const Element<FlightNumber>& top = mission_->field.elements[1];  // high x face
  EXPECT_TRUE(test::is_path_number(top.n[0], 1));
  EXPECT_TRUE(test::is_path_number(top.d, 0.32));
}

TEST_F(LoaderTest, RefusesEveryTruncation) {
  VERIFIES("LASSO-IMG-002~1 LASSO-SYS-011~2");
  for (std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{63}, std::size_t{287}, image_.size / 2, image_.size - 1}) {
    const LoadFailure result = load_image(Bytes(image_.data(), size), *mission_);
    EXPECT_NE(result.status, Status::kOk) << size;
  }
}

TEST_F(LoaderTest, RefusesMoreThanItsBufferHolds) {
  VERIFIES("LASSO-IMG-005~1");
  image_.storage.resize(kMaxImageBytes / 8 + 1);
  put(12, 0);  // number of tables, which is looked at next
  for (const std::size_t size : {kMaxImageBytes, kMaxImageBytes + 8}) {
    image_.size = size;
    put(8, static_cast<std::uint32_t>(size));
    expect_refused(size > kMaxImageBytes ? Status::kOverCapacity : Status::kBadLength);
  }
}

TEST_F(LoaderTest, NamesTheTableThatWasDamagedBeforeTheImageWasSealed) {
  VERIFIES("LASSO-IMG-003~1");
  const std::size_t element = test::table_offset(image_, static_cast<std::uint32_t>(TableId::kElements));
  image_.data()[element + 2] ^= 1;
  put(image_.size - 4, crc32c(ConstBytes(image_.data(), image_.size - 4)));
  EXPECT_EQ(load().table, static_cast<std::uint32_t>(TableId::kElements));
  expect_refused(Status::kBadCrc);
}

TEST_F(LoaderTest, RefusesAFlippedBitAnywhere) {
  VERIFIES("LASSO-IMG-003~1");
  std::uint32_t seed = 12345;
  for (int i = 0; i < 60; ++i) {
    seed = seed * 1664525u + 1013904223u;
    const std::size_t byte = (seed >> 4) % image_.size;
    const auto mask = static_cast<std::uint8_t>(1u << (seed & 7));
    image_.data()[byte] = static_cast<std::uint8_t>(image_.data()[byte] ^ mask);
    EXPECT_NE(load().status, Status::kOk) << "byte " << byte;
    image_.data()[byte] = static_cast<std::uint8_t>(image_.data()[byte] ^ mask);
  }
  EXPECT_EQ(load().status, Status::kOk);
}

// Of an image of a few coarse cells: header and directory, which have words that nobody reads, then some of each table, and the trailer.
TEST_F(LoaderTest, RefusesAFlippedBitOfEachByteOfHeaderDirectoryAndTrailer) {
  VERIFIES("LASSO-IMG-003~1");
  test::BoxModel coarse;
  coarse.cell_m = 0.1;
  image_ = test::make_box_image(preset_parameters(), coarse);
  const std::size_t directory = 4 * (kImageHeaderWords + kLeastTables * kDirectoryEntryWords);
  const std::size_t trailer = image_.size - 4;
  for (std::size_t byte = 0; byte < image_.size; byte = byte < directory || byte >= trailer ? byte + 1 : std::min(byte + 199, trailer)) {
    const auto mask = static_cast<std::uint8_t>(1U << byte % 8);
    image_.data()[byte] = static_cast<std::uint8_t>(image_.data()[byte] ^ mask);
    EXPECT_NE(load().status, Status::kOk) << "byte " << byte;
    image_.data()[byte] = static_cast<std::uint8_t>(image_.data()[byte] ^ mask);
  }
  EXPECT_EQ(load().status, Status::kOk);
}

TEST_F(LoaderTest, RefusesMisalignedMemory) {
  VERIFIES("LASSO-IMG-002~1");
  EXPECT_EQ(load_image(Bytes(image_.data() + 4, image_.size - 4), *mission_).status, Status::kBadValue);
}

TEST_F(LoaderTest, NamesTheHeadersFault) {
  VERIFIES("LASSO-IMG-002~1");
  struct Case {
    std::size_t word;
    std::uint32_t value;
    Status status;
  };
  for (const Case& c : {Case{0, 1, Status::kBadMagic}, Case{1, 99, Status::kBadVersion}, Case{2, 12, Status::kBadLength},
                        Case{3, 10, Status::kBadLength}, Case{6, 1, Status::kBadVersion}}) {
    image_ = whole_image();
    put(4 * c.word, c.value);
    expect_refused(c.status);
  }
}

TEST_F(LoaderTest, RefusesParametersOutOfRange) {
  VERIFIES("LASSO-IMG-004~1");
  MissionParameters parameters = preset_parameters();
  parameters.kernel_width = 1000;
  image_ = test::make_box_image(parameters);
  expect_refused(Status::kBadValue);
  parameters.kernel_width = std::numeric_limits<double>::quiet_NaN();
  image_ = test::make_box_image(parameters);
  expect_refused(Status::kNotFinite);
}

TEST_F(LoaderTest, RefusesIndicesOutsideTheirTables) {
  VERIFIES("LASSO-IMG-005~1");
  struct Case {
    TableId id;
    std::size_t word;
    std::uint32_t value;
    Status status;
  };
  const Case cases[] = {
      {TableId::kFieldGeometry, kLengthFractionBits, 7, Status::kBadValue},
      {TableId::kFieldGeometry, kLengthFractionBits, 31, Status::kBadValue},
      {TableId::kFieldGeometry, kBricksY, 0, Status::kBadValue},
      {TableId::kFieldGeometry, kBricksX, 1024, Status::kBadValue},
      {TableId::kFieldGeometry, kBricksX, 1, Status::kOverCapacity},
      {TableId::kFieldGeometry, kCellSize, 0x80000000u, Status::kBadValue},
      {TableId::kFieldGeometry, kModelRadius, 0, Status::kBadValue},
      {TableId::kElements, 0, 0, Status::kBadValue},            // low x face without its normal
      {TableId::kElements, 4, 1, Status::kBadValue},            // curvature that is not there
      {TableId::kElements, 5, 2, Status::kBadValue},            // unknown flag
      {TableId::kElements, 6, 0x20000000u, Status::kBadValue},  // a side's normal that is too long
      {TableId::kElements, 8, 0x20000000u, Status::kBadValue},
      {TableId::kElements, 9, 0x20000000u, Status::kBadValue},   // likewise of the fourth side, which is one of unit length or none
      {TableId::kElements, 17, 0, Status::kBadValue},            // a fourth side's place without its direction
      {TableId::kElements, 21, 0x80000000u, Status::kBadValue},  // and the other way round
      {TableId::kBricks, 0, 0x7FFFFFFFu, Status::kBadIndex},
      {TableId::kBricks, 0, kEmptyBit, Status::kBadIndex},  // no distance
      {TableId::kBricks, 1, 1u << 20, Status::kBadIndex},
      {TableId::kRayCells, 0, kEmptyBit | 251u, Status::kBadIndex},
      {TableId::kRayCells, 0, 5, Status::kBadIndex},  // a list of nothing
      {TableId::kRayCells, 7, 501u << kListOffsetBits, Status::kBadIndex},
      {TableId::kRayCells, 7, 500u << kListOffsetBits | kListOffsetMask, Status::kBadIndex},
      {TableId::kRayLists, 0, 6, Status::kBadIndex},
      {TableId::kRayLists, 0, kFinalEntry | 6, Status::kBadIndex},
      {TableId::kNearCells, 0, 7, Status::kBadIndex},
      {TableId::kEdges, 6, 0x10000000u, Status::kBadValue},
      {TableId::kEdges, 10, 0x10000000u, Status::kBadValue},
      {TableId::kEdges, 14, 2, Status::kBadValue},
      {TableId::kSearchGrid, kSearchCellSize, 0, Status::kBadValue},
      {TableId::kSearchGrid, kSearchTruncation, 0x80000000u, Status::kBadValue},
      {TableId::kSearchGrid, kSearchSize, 0, Status::kBadValue},
      {TableId::kSearchGrid, kSearchCellsX, 27, Status::kBadValue},
      {TableId::kSearchGrid, kSearchCellsX, 24, Status::kBadLength},  // fewer cells than distances
      {TableId::kSearchGrid, kSearchCellsY, 0, Status::kBadValue},
      {TableId::kSearchGrid, kSearchCellsZ, 129, Status::kBadValue},
      {TableId::kViews, 2, 0, Status::kBadValue},
      {TableId::kSymmetries, 0, 0, Status::kBadValue},
  };
  for (const Case& c : cases) {
    image_ = whole_image();
    spoil(c.id, c.word, c.value);
    SCOPED_TRACE(static_cast<int>(c.id) * 1000 + static_cast<int>(c.word));
    expect_refused(c.status);
  }
}

TEST_F(LoaderTest, LoadsATriangle) {
  VERIFIES("LASSO-IMG-001~1");
  for (const std::size_t word : {9U, 13U, 17U}) spoil(TableId::kElements, word, 0);
  spoil(TableId::kElements, 21, 0x80000000U);
  EXPECT_EQ(load().status, Status::kOk);
}

TEST_F(LoaderTest, RefusesTablesOfAnotherLength) {
  VERIFIES("LASSO-IMG-005~1");
  struct Case {
    TableId id;
    std::uint32_t records;
    Status status;
  };
  const auto parameters = static_cast<std::uint32_t>(parameter_rows().size());
  for (const Case& c : {Case{TableId::kParameters, parameters - 1, Status::kBadLength},
                        Case{TableId::kFieldGeometry, 0, Status::kBadLength}, Case{TableId::kFootPoints, 1, Status::kOverCapacity},
                        Case{TableId::kHull, 3, Status::kOverCapacity}, Case{TableId::kSearchGrid, 0, Status::kBadLength},
                        Case{TableId::kDistances, 8, Status::kBadLength}, Case{TableId::kViews, 5, Status::kOverCapacity}}) {
    image_ = whole_image();
    spoil_directory(c.id, 2, c.records);
    SCOPED_TRACE(static_cast<int>(c.id));
    expect_refused(c.status);
  }
}

TEST_F(LoaderTest, RefusesADirectoryThatPointsAstray) {
  VERIFIES("LASSO-IMG-005~1");
  const std::size_t entry = 4 * (kImageHeaderWords + kDirectoryEntryWords * 2);  // elements
  struct Case {
    std::size_t word;
    std::uint32_t value;
    Status status;
  };
  for (const Case& c : {Case{0, 9, Status::kBadOrder}, Case{1, 20, Status::kBadLength}, Case{2, 1u << 30, Status::kTruncated},
                        Case{3, 0, Status::kBadIndex}, Case{3, 0xFFFFFFF8u, Status::kBadIndex}, Case{3, 289, Status::kBadIndex}}) {
    image_ = whole_image();
    put(entry + 4 * c.word, c.value);
    put(image_.size - 4, crc32c(ConstBytes(image_.data(), image_.size - 4)));
    SCOPED_TRACE(c.word);
    expect_refused(c.status);
  }
}

}  // namespace
}  // namespace lasso
