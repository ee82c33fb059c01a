#include "fsw/core/status.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr int kStatusCount = static_cast<int>(Status::kNotAuthentic) + 1;

TEST(Status, EveryReasonHasAnOwnLowerCaseName) {
  VERIFIES("LASSO-COR-001~1");
  std::set<std::string> names;
  for (int value = 0; value < kStatusCount; ++value) {
    const std::string name = to_string(static_cast<Status>(value));
    EXPECT_FALSE(name.empty());
    EXPECT_NE(name, "unknown") << value;
    for (const char c : name) EXPECT_TRUE(c == ' ' || std::islower(static_cast<unsigned char>(c)) != 0) << name;
    EXPECT_TRUE(names.insert(name).second) << name;
  }
  EXPECT_STREQ(to_string(Status::kOk), "ok");
  EXPECT_STREQ(to_string(Status::kBadCrc), "bad crc");
}

TEST(Status, AnyOtherByteIsUnknown) {
  VERIFIES("LASSO-COR-001~1");
  for (int value = kStatusCount; value < 256; ++value) EXPECT_STREQ(to_string(static_cast<Status>(value)), "unknown");
}

}  // namespace
}  // namespace lasso
