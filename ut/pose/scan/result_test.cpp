#include "fsw/pose/scan/result.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <string>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// Names by code, as telemetry and reports show them.
const char* const kPoseReasons[] = {"valid",          "no_scan",       "too_few_returns", "too_few_inliers", "low_inlier_share",
                                    "model_mismatch", "high_residual", "not_converged",   "singular",        "no_track",
                                    "overrun",        "implausible",   "only_bearing",    "far_from_start",  "searching",
                                    "part_disagrees", "too_fast",      "unchecked",       "contradicted"};
const char* const kStopReasons[] = {"converged", "iteration_limit", "too_few_points", "singular", "not_run"};

TEST(Result, EveryPoseReasonHasItsName) {
  VERIFIES("LASSO-REG-007~2");
  std::uint8_t code = 0;
  for (const char* name : kPoseReasons) EXPECT_EQ(std::string(to_string(static_cast<PoseReason>(code++))), name);
  EXPECT_EQ(static_cast<PoseReason>(code - 1), PoseReason::kContradicted);  // the last of them
  EXPECT_EQ(std::string(to_string(static_cast<PoseReason>(code))), "unknown");
}

TEST(Result, EveryStopReasonHasItsName) {
  VERIFIES("LASSO-REG-007~2");
  std::uint8_t code = 0;
  for (const char* name : kStopReasons) EXPECT_EQ(std::string(to_string(static_cast<StopReason>(code++))), name);
  EXPECT_EQ(static_cast<StopReason>(code - 1), StopReason::kNotRun);
  EXPECT_EQ(std::string(to_string(static_cast<StopReason>(code))), "unknown");
}

TEST(Result, IsValidOnlyForTheReasonValid) {
  VERIFIES("LASSO-REG-007~2");
  Registration result;
  EXPECT_FALSE(result.valid());  // nothing was estimated yet
  for (std::uint8_t code = 0; code < std::size(kPoseReasons); ++code) {
    result.reason = static_cast<PoseReason>(code);
    EXPECT_EQ(result.valid(), code == 0);
  }
}

}  // namespace
}  // namespace lasso
