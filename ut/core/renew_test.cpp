#include "fsw/core/renew.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

struct Counted {
  explicit Counted(int v) : value(v) {}
  Counted(const Counted& other) : value(other.value), copies(other.copies + 1) {}
  Counted& operator=(const Counted&) = default;
  int value;
  int copies = 0;
};

TEST(Renew, MakesTheValueInPlaceWithoutACopy) {
  VERIFIES("LASSO-PLT-006~1");
  Counted object(1);
  const Counted* const place = &object;
  renew(object, [] { return Counted(7); });
  EXPECT_EQ(place->value, 7);
  EXPECT_EQ(place->copies, 0);
}

}  // namespace
}  // namespace lasso
