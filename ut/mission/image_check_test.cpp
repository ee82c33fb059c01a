#include "fsw/mission/image_check.hpp"

#include <gtest/gtest.h>

#include <string>

#include "ut/support/box_image.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

struct Checked {
  explicit Checked(test::TestImage& bytes, std::uint32_t words = 1U << 28) {
    ImageCheck check;
    check.begin(Bytes(bytes.data(), bytes.size));
    while (!check.step(words)) ++steps;
    image = check.image();
    result = check.result();
  }
  FlightImage image;
  LoadFailure result;
  std::uint32_t steps = 0;
};

TEST(ImageCheck, FindsTheTablesAndChangesNoByte) {
  VERIFIES("LASSO-IMG-001~1 LASSO-IMG-002~1");
  MissionParameters parameters = preset_parameters();
  parameters.points = 512;
  test::TestImage bytes = test::make_box_image(parameters);
  const auto before = bytes.storage;
  const Checked checked(bytes);
  EXPECT_EQ(checked.result.status, Status::kOk) << checked.result.what;
  EXPECT_EQ(bytes.storage, before);
  EXPECT_EQ(parameters_of(checked.image[TableId::kParameters]).points, 512);
  EXPECT_EQ(checked.image[TableId::kElements].records, 6U);
  EXPECT_EQ(checked.image[TableId::kHull].bytes(), 8U * 3U * 4U);
  EXPECT_EQ(checked.image[TableId::kParts].records, 0U);
}

TEST(ImageCheck, RefusesTheFormatBeforeThisOne) {
  VERIFIES("LASSO-IMG-002~1");
  test::TestImage bytes = test::make_box_image(preset_parameters());
  bytes.data()[7] = 3;
  const Checked checked(bytes);
  EXPECT_EQ(checked.result.status, Status::kBadVersion);
  EXPECT_NE(std::string(checked.result.what).find("compile the mission again"), std::string::npos);
}

// In steps of any size it comes to the same end; a step goes no farther than its words and a record.
TEST(ImageCheck, GoesOnStepByStep) {
  VERIFIES("LASSO-IMG-005~1");
  test::TestImage bytes = test::make_box_image(preset_parameters());
  const auto all_words = static_cast<std::uint32_t>(bytes.size / 4);
  for (const std::uint32_t words : {1U, 7U, 1000U}) {
    const Checked checked(bytes, words);
    EXPECT_EQ(checked.result.status, Status::kOk) << checked.result.what;
    EXPECT_GE(checked.steps * (words + kLargestRecord_words), 2 * all_words);  // check sums of the whole and of the tables, and records
    EXPECT_LE(checked.steps, 4 * all_words / words + 200);
  }
  bytes.data()[test::table_offset(bytes, static_cast<std::uint32_t>(TableId::kElements))] ^= 0x40;
  test::repair_crcs(bytes);
  const Checked spoiled(bytes, 13);
  EXPECT_EQ(spoiled.result.status, Status::kBadValue);
  EXPECT_EQ(spoiled.result.table, static_cast<std::uint32_t>(TableId::kElements));
  EXPECT_EQ(spoiled.result.record, 0U);
}

// Of a field whose lengths are in 1/256 m and whose cells are 1 m wide.
class GridImage {
 public:
  GridImage() {
    put(kLengthFractionBits, 8);
    put(kCellSize, 256);
    for (std::size_t axis = 0; axis < 3; ++axis) put(kOriginX + axis, 0);
  }
  void put(std::size_t word, std::int32_t value) {
    std::uint8_t* place = image_.data() + geometry() + 4 * word;
    for (std::size_t i = 0; i < 4; ++i) place[i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
    test::repair_crcs(image_);
  }
  LoadFailure check_from(std::size_t axis, double low_m) {
    put(kOriginX + axis, static_cast<std::int32_t>(256 * low_m));
    return Checked(image_).result;
  }
  double width_m(std::size_t axis) { return 8 * image_.data()[geometry() + 4 * (kBricksX + axis) + 3]; }

 private:
  std::size_t geometry() { return test::table_offset(image_, static_cast<std::uint32_t>(TableId::kFieldGeometry)); }
  test::TestImage image_ = test::make_box_image(preset_parameters());
};

TEST(ImageCheck, RefusesAGridThatReachesFartherThanTheNumberTypeHolds) {
  VERIFIES("LASSO-IMG-004~1 LASSO-IMG-005~1");
  constexpr double kFarthest_m = FlightNumber::kFarthest_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    GridImage image;
    const double last_m = kFarthest_m - image.width_m(axis);
    EXPECT_EQ(image.check_from(axis, -kFarthest_m).status, Status::kOk) << axis;
    EXPECT_EQ(image.check_from(axis, last_m).status, Status::kOk) << axis;
    for (const double low_m : {-kFarthest_m - 1.0 / 256, last_m + 1.0 / 256}) {
      const LoadFailure refused = image.check_from(axis, low_m);
      EXPECT_EQ(refused.status, Status::kBadValue) << axis << ' ' << low_m;
      EXPECT_EQ(refused.table, static_cast<std::uint32_t>(TableId::kFieldGeometry));
      EXPECT_NE(std::string(refused.what).find("larger than the number type holds"), std::string::npos) << refused.what;
    }
  }
}

TEST(ImageCheck, RefusesCellsThatAreSmallerThanTheNumberTypeHolds) {
  VERIFIES("LASSO-IMG-004~1 LASSO-IMG-005~1");
  constexpr std::int32_t kBits = 30;
  GridImage image;
  image.put(kLengthFractionBits, kBits);
  const auto smallest = static_cast<std::int32_t>(FlightNumber::kSmallestCell_m * (1 << kBits));
  image.put(kCellSize, smallest);
  EXPECT_STREQ(image.check_from(0, 0).what, "cell size");
  image.put(kCellSize, smallest + 1);
  EXPECT_EQ(image.check_from(0, 0).status, Status::kOk);
}

// Nothing is checked before it is told what.
TEST(ImageCheck, IsDoneBeforeItBegins) {
  VERIFIES("LASSO-IMG-005~1");
  ImageCheck check;
  EXPECT_TRUE(check.step(10));
  EXPECT_EQ(check.result().status, Status::kOk);
}

}  // namespace
}  // namespace lasso
