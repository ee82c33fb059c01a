#include "fsw/mission/image_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "cfg/capacities.hpp"
#include "fsw/mission/image_records.hpp"
#include "fsw/mission/loader.hpp"
#include "ut/support/box_frames.hpp"
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

test::TestImage framed_image(const std::vector<NamedFrame>& frames) {
  return test::make_image(preset_parameters(), test::with_frames(test::make_box_tables(test::BoxModel{}), frames));
}

TEST(ImageCheck, ATableOfNamedFramesIsOneMoreThanOtherImagesHave) {
  VERIFIES("LASSO-LNK-050~1 LASSO-LNK-051~1 LASSO-IMG-001~1");
  test::TestImage without = framed_image({});
  EXPECT_EQ(without.data()[15], kLeastTables);
  EXPECT_EQ(Checked(without).image[TableId::kNamedFrames].records, 0U);
  const NamedFrame put = test::grapple_in_port();
  test::TestImage image = framed_image({NamedFrame{}, put});
  EXPECT_EQ(image.data()[15], kTableCount);
  const Checked checked(image);
  ASSERT_EQ(checked.result.status, Status::kOk) << checked.result.what;
  ASSERT_EQ(checked.image[TableId::kNamedFrames].records, 2U);
  const NamedFrame found = named_frame_of(checked.image[TableId::kNamedFrames], 1);
  EXPECT_EQ(found.T_target_of.q.coeffs(), put.T_target_of.q.coeffs());
  EXPECT_EQ(found.T_target_of.p, put.T_target_of.p);
  EXPECT_EQ(found.T_in_sensor.q.coeffs(), put.T_in_sensor.q.coeffs());
  EXPECT_EQ(found.T_in_sensor.p, put.T_in_sensor.p);
}

TEST(ImageLoad, GivesNamedFramesByTheirPlaceAndNoneThatHasDecayed) {
  VERIFIES("LASSO-LNK-050~1");
  const NamedFrame put = test::grapple_in_port();
  test::TestImage image = framed_image({NamedFrame{}, put});
  ImageLoad load;
  ASSERT_EQ(load.run(Bytes(image.data(), image.size)).status, Status::kOk);
  ASSERT_EQ(load.named_frames(), 2U);
  NamedFrame found;
  ASSERT_TRUE(load.find_named_frame(1, found));
  EXPECT_EQ(found.T_in_sensor.p, put.T_in_sensor.p);
  EXPECT_FALSE(load.find_named_frame(2, found));
  std::fill_n(image.data() + test::table_offset(image, static_cast<std::uint32_t>(TableId::kNamedFrames)), 8, std::uint8_t{0x7F});
  EXPECT_FALSE(load.find_named_frame(0, found));
  EXPECT_TRUE(load.find_named_frame(1, found));
}

TEST(ImageCheck, RefusesNamedFramesThatAreNone) {
  VERIFIES("LASSO-LNK-050~1 LASSO-IMG-005~1 LASSO-IMG-003~1");
  const auto refused = [](test::TestImage image) { return Checked(image).result; };
  EXPECT_EQ(refused(framed_image(std::vector<NamedFrame>(kMaxNamedFrames))).status, Status::kOk);
  EXPECT_EQ(refused(framed_image(std::vector<NamedFrame>(kMaxNamedFrames + 1))).status, Status::kOverCapacity);
  NamedFrame bad = test::grapple_in_port();
  bad.T_target_of.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(framed_image({NamedFrame{}, bad})).record, 1U);
  bad = test::grapple_in_port();
  bad.T_in_sensor.q.w() += 0.1;
  const LoadFailure found = refused(framed_image({bad}));
  EXPECT_EQ(found.status, Status::kBadValue);
  EXPECT_EQ(found.table, static_cast<std::uint32_t>(TableId::kNamedFrames));
  for (const std::uint32_t tables : {kLeastTables - 1, kTableCount + 1}) {
    test::TestImage image = framed_image({});
    image.data()[15] = static_cast<std::uint8_t>(tables);
    test::repair_crcs(image);
    EXPECT_EQ(refused(image).status, Status::kBadLength);
  }
}

// As long as header and directory of 19 tables, and a checksum.
TEST(ImageCheck, RefusesAnImageThatEndsInItsDirectory) {
  VERIFIES("LASSO-IMG-003~1");
  test::TestImage image = framed_image({NamedFrame{}});
  image.size = 4 * (kImageHeaderWords + kLeastTables * kDirectoryEntryWords) + 4;
  image.data()[8] = image.data()[9] = 0;
  image.data()[10] = static_cast<std::uint8_t>(image.size >> 8);
  image.data()[11] = static_cast<std::uint8_t>(image.size);
  EXPECT_EQ(Checked(image).result.status, Status::kTruncated);
}

TEST(ImageCheck, RefusesTheFormatBeforeThisOne) {
  VERIFIES("LASSO-IMG-002~1");
  test::TestImage bytes = test::make_box_image(preset_parameters());
  bytes.data()[7] = 3;
  const Checked checked(bytes);
  EXPECT_EQ(checked.result.status, Status::kBadVersion);
  EXPECT_NE(std::string(checked.result.what).find("compile the mission again"), std::string::npos);
}

TEST(ImageTable, WordsAreBigEndian) {
  VERIFIES("LASSO-IMG-001~1");
  std::uint8_t bytes[] = {0, 0, 0, 0, 0x8A, 0x0B, 0x0C, 0x0D};
  const ImageTable table{bytes, 1, 2};
  EXPECT_EQ(table.bytes(), 8U);
  EXPECT_EQ(table.word(1, 0), 0x8A0B0C0DU);
  EXPECT_EQ(table.signed_word(1, 0), -0x75F4F3F3);
}

TEST(IsUnit, WithinAThousandthOfTheSquare) {
  VERIFIES("LASSO-IMG-002~1");
  EXPECT_TRUE(is_unit(0.9991));
  EXPECT_TRUE(is_unit(1.0009));
  EXPECT_FALSE(is_unit(0.999));
  EXPECT_FALSE(is_unit(1.001));
}

// In steps of any size it comes to the same end; a step goes no farther than its words and a record.
TEST(ImageCheck, GoesOnStepByStep) {
  VERIFIES("LASSO-IMG-005~1");
  test::TestImage bytes = test::make_box_image(preset_parameters());
  const auto all_words = static_cast<std::uint32_t>(bytes.size / 4);
  for (const std::uint32_t words : {1U, 7U, 1000U}) {
    const Checked checked(bytes, words);
    EXPECT_EQ(checked.result.status, Status::kOk) << checked.result.what;
    EXPECT_GE(checked.steps * (words + kLargestRecord_words), 2 * all_words);  // checksums of the whole and of the tables, and records
    EXPECT_LE(checked.steps, 4 * all_words / words + 200);
  }
  bytes.data()[test::table_offset(bytes, static_cast<std::uint32_t>(TableId::kElements))] ^= 0x40;
  test::repair_crcs(bytes);
  const Checked spoiled(bytes, 13);
  EXPECT_EQ(spoiled.result.status, Status::kBadValue);
  EXPECT_EQ(spoiled.result.table, static_cast<std::uint32_t>(TableId::kElements));
  EXPECT_EQ(spoiled.result.record, 0U);
}

// The image has 128 m as its longest length, which floating point holds, and fixed point does not.
constexpr bool kHoldsAll = FlightNumber::kFarthest_m > 128;

void expect_held_or_refused(test::TestImage& image, TableId id, std::uint32_t record = 0) {
  test::repair_crcs(image);
  const Checked checked(image);
  EXPECT_EQ(checked.result.status, kHoldsAll ? Status::kOk : Status::kBadValue) << checked.result.what;
  EXPECT_EQ(checked.result.table, kHoldsAll ? 0U : static_cast<std::uint32_t>(id));
  EXPECT_EQ(checked.result.record, kHoldsAll ? 0U : record);
  EXPECT_EQ(std::string(checked.result.what).find("number type holds") != std::string::npos, !kHoldsAll) << checked.result.what;
}

TEST(ImageCheck, RefusesLengthsThatTheNumberTypeDoesNotHold) {
  VERIFIES("LASSO-IMG-021~1 LASSO-IMG-005~1");
  struct Case {
    TableId id;
    std::size_t word;
  };
  for (const Case& c : {Case{TableId::kFieldGeometry, kOriginY}, Case{TableId::kFieldGeometry, kCenterZ},
                        Case{TableId::kFieldGeometry, kCenterX}, Case{TableId::kElements, 3}, Case{TableId::kElements, 20},
                        Case{TableId::kCurvatures, 4}, Case{TableId::kFootPoints, 1}, Case{TableId::kEdges, 5}, Case{TableId::kEdges, 9},
                        Case{TableId::kEdges, 13}, Case{TableId::kHull, 2}, Case{TableId::kViews, 3}, Case{TableId::kSymmetries, 6}}) {
    SCOPED_TRACE(static_cast<int>(c.id) * 1000 + static_cast<int>(c.word));
    test::TestImage image = test::make_box_image(preset_parameters());
    std::uint8_t* word = image.data() + test::table_offset(image, static_cast<std::uint32_t>(c.id)) + 4 * c.word;
    word[0] = 0x80;  // -128 m
    for (std::size_t i = 1; i < 4; ++i) word[i] = 0;
    expect_held_or_refused(image, c.id);
  }
}

// In the image's coarsest unit, of 1/256 m.
TEST(ImageCheck, RefusesLengthsThatNoNumberTypeHolds) {
  VERIFIES("LASSO-IMG-021~1");
  test::TestImage image = test::make_box_image(preset_parameters());
  image.data()[test::table_offset(image, static_cast<std::uint32_t>(TableId::kFieldGeometry)) + 3] = 8;
  image.data()[test::table_offset(image, static_cast<std::uint32_t>(TableId::kHull))] = 0x7F;
  test::repair_crcs(image);
  const Checked checked(image);
  EXPECT_EQ(checked.result.status, Status::kBadValue);
  EXPECT_NE(std::string(checked.result.what).find("number type holds"), std::string::npos) << checked.result.what;
}

TEST(ImageCheck, RefusesParametersThatTheNumberTypeDoesNotHold) {
  VERIFIES("LASSO-IMG-021~1 LASSO-IMG-004~1");
  struct Case {
    const char* key;
    double MissionParameters::*member;
    double value;
  };
  const Case cases[] = {{"sensor.range_max_m", &MissionParameters::range_max_m, 127},
                        {"sensor.sigma0_m", &MissionParameters::sigma0_m, 0.09},
                        {"sensor.sigma_angle_rad", &MissionParameters::sigma_angle_rad, 0.005},
                        {"scan.duration_s", &MissionParameters::duration_s, 3.8}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.key);
    MissionParameters parameters = preset_parameters();
    parameters.*c.member = c.value;
    std::uint32_t row = 0;
    while (std::string(parameter_rows()[row].key) != c.key) ++row;
    test::TestImage image = test::make_box_image(parameters);
    expect_held_or_refused(image, TableId::kParameters, row);
  }
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
