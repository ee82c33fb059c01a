#include "fsw/exec/self_test.hpp"

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(SelfTests, PassOnTheProcessorThatTheComponentIsVerifiedOn) {
  VERIFIES("LASSO-HLT-009~2");
  EXPECT_EQ(failed_self_tests(), 0u);
}

TEST(SelfTests, NameWhatFailed) {
  VERIFIES("LASSO-HLT-009~2");
  const KnownAnswer answers[] = {{SelfTest::kRounding, 1, 1}, {SelfTest::kCrc16, 1, 2}, {SelfTest::kCodec, 5, 4}, {SelfTest::kCodec, 4, 4}};
  EXPECT_EQ(failed_among(Span<const KnownAnswer>(answers)), (1u << 3) | (1u << 5));
}

}  // namespace
}  // namespace lasso
