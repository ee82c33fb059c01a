#include "fsw/mission/image_check.hpp"

#include <gtest/gtest.h>

#include <string>

#include "ut/support/box_image.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

struct Checked {
  explicit Checked(test::TestImage& bytes) {
    image.bytes = Bytes(bytes.data(), bytes.size);
    result = check_image(image, parameters);
  }
  FlightImage image;
  MissionParameters parameters{};
  LoadFailure result;
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
  EXPECT_EQ(checked.parameters.points, 512);
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

}  // namespace
}  // namespace lasso
