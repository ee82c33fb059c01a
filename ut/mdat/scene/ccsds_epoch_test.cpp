#include "mdat/scene/ccsds_epoch.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

double since_2000(const char* text) {
  const auto from = parse_epoch("2000-01-01T00:00:00"), to = parse_epoch(text);
  EXPECT_TRUE(to.has_value()) << text;
  return from && to ? seconds_between(*from, *to) : -1;
}

// Against counts of days by hand.
TEST(Epoch, CountsDaysAndSeconds) {
  VERIFIES("LASSO-SCN-018~1");
  EXPECT_EQ(since_2000("2000-01-01T00:00:00"), 0);
  EXPECT_EQ(since_2000("2000-03-01T00:00:00Z"), 60 * 86400.0) << "2000 was a leap year";
  EXPECT_EQ(since_2000("2001-01-01T00:00:00"), 366 * 86400.0);
  EXPECT_EQ(since_2000("1999-12-31T23:59:59.5"), -0.5);
  EXPECT_EQ(since_2000("2026-11-27T08:15:30.25"), (26 * 365 + 7 + 330) * 86400.0 + 8 * 3600 + 15 * 60 + 30.25);
  EXPECT_EQ(since_2000("2026-331T08:15:30.25Z"), since_2000("2026-11-27T08:15:30.25"));
  EXPECT_EQ(since_2000("2000-366T00:00:00"), 365 * 86400.0);
  EXPECT_NEAR(seconds_between(*parse_epoch("2026-11-27T23:59:59.999999999"), *parse_epoch("2026-11-28T00:00:00.000000001")), 2e-9, 1e-10);
}

TEST(Epoch, RefusesWhatIsNone) {
  VERIFIES("LASSO-SCN-018~1");
  for (const char* text : {"",
                           "2026",
                           "2026-11-27",
                           "2026-11-27 08:15:30",
                           "2026-11-27T08:15",
                           "2026-11-27T08:15:3",
                           "2026-11-27T24:00:00",
                           "2026-11-27T08:60:30",
                           "2026-11-27T08:15:60",
                           "2026-13-01T00:00:00",
                           "2026-02-29T00:00:00",
                           "2025-366T00:00:00",
                           "2026-000T00:00:00",
                           "26-11-27T08:15:30",
                           "2026-11-27T08:15:30.25UTC",
                           "2026-11-27T08:15:30,25",
                           "2026-11-27T08:15:3e1",
                           "2026-11-27T08:15:-3",
                           "+026-11-27T08:15:30",
                           "2026-11-27T08:15:30.2Z5",
                           "2026/11/27T08:15:30",
                           "2026-1-27T08:15:30",
                           "2026-11-T08:15:30",
                           "2026-11-27T08.15:30",
                           "2026-11-27T08:15.30",
                           "2026-11-27Tab:15:30"}) {
    EXPECT_FALSE(parse_epoch(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace lasso::mdat::scene
