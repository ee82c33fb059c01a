#include "ut/support/verifies.hpp"

#include <gtest/gtest.h>

#include <string>

namespace {

std::string recorded() {
  const ::testing::TestResult* result = ::testing::UnitTest::GetInstance()->current_test_info()->result();
  std::string all;
  for (int i = 0; i < result->test_property_count(); ++i) {
    all += std::string("[") + result->GetTestProperty(i).key() + "=" + result->GetTestProperty(i).value() + "]";
  }
  return all;
}

TEST(Verifies, RecordsTheItemsForTheReport) {
  VERIFIES("LASSO-VER-002~1");
  EXPECT_EQ(recorded(), "[verifies=LASSO-VER-002~1]");
}

TEST(Verifies, UsesInOneTestAddUp) {
  VERIFIES("LASSO-VER-002~1");
  RecordProperty("other", "kept");
  VERIFIES("LASSO-VER-002~1");
  EXPECT_EQ(recorded(), "[verifies=LASSO-VER-002~1 LASSO-VER-002~1][other=kept]");
}

}  // namespace
