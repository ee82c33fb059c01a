#include "mdat/common/share_text.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(ShareText, HasTheDigitsThatCount) {
  VERIFIES("LASSO-GND-054~1");
  EXPECT_EQ(share_text(1), "100 %");
  EXPECT_EQ(share_text(0), "0 %");
  EXPECT_EQ(share_text(0.853), "85.3 %");
  EXPECT_EQ(share_text(0.994), "99.40 %");
  EXPECT_EQ(share_text(0.00012), "0.012 %");
}

TEST(ShareText, PromisesNoMoreThanTheLimits) {
  VERIFIES("LASSO-GND-054~1");
  EXPECT_EQ(limits_text({0.98999, 0.98999}), "98.9 % to 99.0 %");
  EXPECT_EQ(lower_limit_text(0.0139), "1.3 %");
  EXPECT_EQ(upper_limit_text(0.0131), "1.4 %");
}

}  // namespace
}  // namespace lasso::mdat
