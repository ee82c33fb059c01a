#include "fsw/core/invariant.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <thread>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(Invariant, NothingHappensWhereItHolds) { invariant(true, "never said"); }

TEST(InvariantDeathTest, OutsideOfAComponentTheFailureNamesNone) {
  VERIFIES("LASSO-COR-010~1");
  EXPECT_DEATH(invariant(false, "of nobody"), "failed: of nobody, of APID 0,");
}

TEST(InvariantDeathTest, TheFailureNamesTheComponentWhoseCodeRan) {
  VERIFIES("LASSO-COR-010~1");
  Identity first, second;
  first.apid = 0x3D1;
  second.apid = 0x3D2;
  second.context = reinterpret_cast<void*>(0xABCD);
  const Running outer(first);
  {
    const Running inner(second);
    EXPECT_DEATH(invariant(false, "in the inner one"), "in the inner one, of APID 978, context 0xabcd");
  }
  EXPECT_DEATH(invariant(false, "in the outer one"), "in the outer one, of APID 977, context \\(nil\\)");
}

#ifdef __linux__
TEST(InvariantDeathTest, AnotherThreadRunsNobodysCode) {
  VERIFIES("LASSO-COR-010~1");
  const Identity identity;
  const Running running(identity);
  EXPECT_DEATH(std::thread([] { invariant(false, "elsewhere"); }).join(), "elsewhere, of APID 0,");
}
#endif

TEST(Identity, AnApidIsOneOfTelemetryThatIsNeitherTimeNorIdle) {
  VERIFIES("LASSO-LNK-043~2");
  EXPECT_TRUE(is_valid({}));
  for (const std::uint16_t apid : std::initializer_list<std::uint16_t>{1, 0x3D2, 0x7FE}) EXPECT_TRUE(is_valid({apid, nullptr}));
  for (const std::uint16_t apid : std::initializer_list<std::uint16_t>{0, 0x7FF, 0x800, 0xFFFF}) EXPECT_FALSE(is_valid({apid, nullptr}));
}

}  // namespace
}  // namespace lasso
