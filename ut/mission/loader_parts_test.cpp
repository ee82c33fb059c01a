// Parts of the target in a flight image, each with an image of its own.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "fsw/mission/mission.hpp"
#include "ut/support/box_parts.hpp"
#include "ut/support/path_numbers.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxPart;
using test::BoxTables;

class LoaderPartsTest : public ::testing::Test {
 protected:
  static const BoxTables& whole() {
    static const BoxTables tables = test::make_box_tables(test::BoxModel{{0.02, -0.01, 0.03}, {0.30, 0.20, 0.12}, 0.06, 0.06});
    return tables;
  }
  static const BoxTables& two_parts() {
    static const BoxTables tables = test::with_parts(whole(), parts_of_test(), preset_parameters());
    return tables;
  }
  static std::vector<BoxPart> parts_of_test() {
    std::vector<BoxPart> parts = test::two_halves();  // of coarse cells, which load fast
    parts[0].box.cell_m = 0.06;
    parts[1].range_min_m = 1.5;
    parts[1].range_max_m = 7;
    parts[1].view = Vec3(0, 0.6, -0.8);
    parts[1].cone_cosine = 0.25;
    parts[1].priority = 3;
    return parts;
  }

  LoadFailure load(const BoxTables& tables) {
    image_ = test::make_image(preset_parameters(), tables);
    return load_image(Bytes(image_.data(), image_.size), *mission_, *parts_);
  }
  // With a value of the second part's record changed.
  LoadFailure load_with(PartValue value, double changed) {
    BoxTables tables = two_parts();
    test::Words words;
    test::append_value(changed, words);
    for (std::size_t i = 0; i < 2; ++i) tables[15][kPartWords + 2 * std::size_t{value} + i] = words[i];
    return load(tables);
  }
  LoadFailure load_with_word(std::uint32_t word, std::uint32_t changed) {
    BoxTables tables = two_parts();
    tables[15][kPartWords + word] = changed;
    return load(tables);
  }
  std::uint32_t word_of_part(std::uint32_t part, std::uint32_t word) const { return two_parts()[15][part * kPartWords + word]; }

  void expect_refused(const LoadFailure& failure, Status status, std::uint32_t table, std::uint32_t record) {
    EXPECT_EQ(failure.status, status) << failure.what;
    EXPECT_EQ(failure.table, table) << failure.what;
    EXPECT_EQ(failure.record, record) << failure.what;
    EXPECT_EQ(mission_->id, 4711U);
    EXPECT_TRUE(parts_->empty());
  }
  void SetUp() override { mission_->id = 4711; }

  test::TestImage image_;
  std::unique_ptr<Mission> mission_ = std::make_unique<Mission>();
  std::unique_ptr<Parts> parts_ = std::make_unique<Parts>();
};

constexpr auto kPartsTable = static_cast<std::uint32_t>(TableId::kParts);

TEST_F(LoaderPartsTest, LoadsEachPartWithItsModelAndItsPlace) {
  VERIFIES("LASSO-IMG-001~1");
  ASSERT_EQ(load(two_parts()).status, Status::kOk);
  EXPECT_NEAR(mission_->radius_m, Vec3(0.32, 0.21, 0.15).norm(), 1e-6);
  ASSERT_EQ(parts_->size(), 2U);
  const Part& right = (*parts_)[1];
  EXPECT_NEAR(right.mission.radius_m, Vec3(0.15, 0.12, 0.20).norm(), 1e-6);
  EXPECT_EQ(right.mission.field.element_count, 6U);
  EXPECT_TRUE(test::is_path_number(right.mission.field.elements[3].n[1], 1));
  EXPECT_TRUE(test::is_path_number(right.mission.field.elements[3].d, 0.12));
  EXPECT_EQ(right.mission.parameters.silhouettes, 0);
  EXPECT_NEAR(right.T_target_part.p.x(), 0.17, 1e-15);
  EXPECT_NEAR(right.T_target_part.q.x(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(right.T_target_part.q.w(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(right.range_min_m, 1.5);
  EXPECT_EQ(right.range_max_m, 7);
  EXPECT_EQ(right.view, Vec3(0, 0.6, -0.8));
  EXPECT_EQ(right.cone_cosine, 0.25);
  EXPECT_EQ(right.priority, 3);
  EXPECT_NEAR((*parts_)[0].T_target_part.p.x(), -0.13, 1e-15);
}

TEST_F(LoaderPartsTest, AnImageWithoutPartsForgetsThoseOfTheOneBefore) {
  VERIFIES("LASSO-IMG-001~1");
  ASSERT_EQ(load(two_parts()).status, Status::kOk);
  ASSERT_EQ(load(whole()).status, Status::kOk);
  EXPECT_TRUE(parts_->empty());
}

TEST_F(LoaderPartsTest, WhoHasNoUseForThePartsLoadsTheWhole) {
  VERIFIES("LASSO-IMG-001~1");
  image_ = test::make_image(preset_parameters(), two_parts());
  EXPECT_EQ(load_image(Bytes(image_.data(), image_.size), *mission_).status, Status::kOk);
  EXPECT_EQ(mission_->field.element_count, 6U);
}

TEST_F(LoaderPartsTest, APartWithoutAModelIsRefusedByName) {
  VERIFIES("LASSO-MOD-182~2");
  const LoadFailure failure = load_with_word(kPartImageBytes, 0);
  expect_refused(failure, Status::kMissing, kPartsTable, 1);
  EXPECT_STREQ(failure.what, "a part without a model");
}

TEST_F(LoaderPartsTest, RefusesImagesOfPartsThatLieAnywhereElse) {
  VERIFIES("LASSO-IMG-002~1");
  const std::uint32_t offset = word_of_part(1, kPartImageOffset);
  const std::uint32_t size = word_of_part(1, kPartImageBytes);
  const auto all = static_cast<std::uint32_t>(4 * two_parts()[16].size());
  for (const std::uint32_t wrong : {offset + 4, std::uint32_t{0}, all + 8, offset + 8}) {
    expect_refused(load_with_word(kPartImageOffset, wrong), Status::kBadIndex, kPartsTable, 1);
  }
  expect_refused(load_with_word(kPartImageBytes, all - offset + 1), Status::kBadIndex, kPartsTable, 1);
  expect_refused(load_with_word(kPartImageBytes, size - 4), Status::kBadLength, 200, 0);
}

TEST_F(LoaderPartsTest, RefusesValuesWithoutMeaning) {
  VERIFIES("LASSO-IMG-004~1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    PartValue value;
    double wrong;
  } cases[] = {{kPartQx, 0.5},          {kPartY, nan},
               {kPartRangeMin, -1},     {kPartRangeMin, nan},
               {kPartRangeMin, 7},      {kPartRangeMax, std::numeric_limits<double>::infinity()},
               {kPartViewZ, 0.5},       {kPartConeCosine, -1.01},
               {kPartConeCosine, 1.01}, {kPartPriority, 0},
               {kPartPriority, 1001}};
  for (const auto& c : cases) expect_refused(load_with(c.value, c.wrong), Status::kBadValue, kPartsTable, 1);
}

TEST_F(LoaderPartsTest, NamesThePartWhoseImageIsDamaged) {
  VERIFIES("LASSO-IMG-003~1");
  BoxTables tables = two_parts();
  tables[16][word_of_part(1, kPartImageOffset) / 4 + 200] ^= 4;
  expect_refused(load(tables), Status::kBadCrc, 200, 0);
}

TEST_F(LoaderPartsTest, RefusesPartsOfParts) {
  VERIFIES("LASSO-IMG-004~1");
  BoxTables tables = whole();
  test::TestImage nested = test::make_image(preset_parameters(), two_parts());
  test::append_part(test::half_box(true), tables[15]);
  tables[15].push_back(0);
  tables[15].push_back(static_cast<std::uint32_t>(nested.size));
  test::append_image(nested, tables[16]);
  expect_refused(load(tables), Status::kBadValue, 100 + kPartsTable, 0);
}

TEST_F(LoaderPartsTest, RefusesMorePartsThanThereIsRoomFor) {
  VERIFIES("LASSO-IMG-005~1");
  BoxTables tables = whole();
  for (std::size_t i = 0; i <= kMaxParts; ++i)
    tables[15].insert(tables[15].end(), two_parts()[15].begin(), two_parts()[15].begin() + kPartWords);
  expect_refused(load(tables), Status::kOverCapacity, kPartsTable, 0);
}

}  // namespace
}  // namespace lasso
