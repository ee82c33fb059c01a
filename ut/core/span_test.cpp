#include "fsw/core/span.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(Span, ViewsAnArrayWithoutCopying) {
  VERIFIES("LASSO-COR-008~2");
  int a[5] = {1, 2, 3, 4, 5};
  const Span<int> s(a);
  s[2] = 30;
  EXPECT_EQ(a[2], 30);
  EXPECT_EQ(std::accumulate(s.begin(), s.end(), 0), 42);
  const Span<const int> constant = s;
  EXPECT_EQ(constant.data(), a);
  EXPECT_EQ(constant.size(), 5U);
  EXPECT_TRUE(Span<int>().empty());
  EXPECT_EQ(Span<int>().begin(), Span<int>().end());
}

TEST(Span, PartsAreExact) {
  VERIFIES("LASSO-COR-008~2");
  int a[6] = {0, 1, 2, 3, 4, 5};
  const Span<int> s(a);
  for (std::size_t offset = 0; offset <= 6; ++offset) {
    for (std::size_t n = 0; n <= 6 - offset; ++n) {
      const Span<int> part = s.subspan(offset, n);
      EXPECT_EQ(part.data(), a + offset);
      EXPECT_EQ(part.size(), n);
    }
    EXPECT_EQ(s.first(offset).size(), offset);
  }
}

TEST(SpanDeathTest, AccessOutsideIsAnInvariant) {
  VERIFIES("LASSO-COR-008~2");
  int a[4] = {};
  const Span<int> s(a);
  EXPECT_DEATH(static_cast<void>(s[4]), "invariant failed: Span index");
  EXPECT_DEATH(static_cast<void>(Span<int>()[0]), "invariant failed: Span index");
  EXPECT_DEATH(static_cast<void>(s.first(5)), "invariant failed: Span first");
  EXPECT_DEATH(static_cast<void>(s.subspan(5, 0)), "invariant failed: Span subspan");
  EXPECT_DEATH(static_cast<void>(s.subspan(2, 3)), "invariant failed: Span subspan");
  // Offset plus length wraps around to a small number: still refused.
  EXPECT_DEATH(static_cast<void>(s.subspan(2, std::numeric_limits<std::size_t>::max())), "invariant failed: Span subspan");
}

}  // namespace
}  // namespace lasso
