#include "mdat/run/results.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Results, AVariantWhosePosesAreWrongIsNamed) {
  VERIFIES("LASSO-MDT-002~1");
  TableResult table;
  for (const char* title : {"quiet", "loud", "louder"}) {
    VariantResult variant;
    variant.variant.title = title;
    variant.all.frames = 300;
    table.variants.push_back(variant);
  }
  EXPECT_TRUE(warnings_of(table).empty());
  table.variants[1].all.wrong = 7;
  const std::vector<std::string> warnings = warnings_of(table);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].find("loud: 7 of 300 frames say valid and are wrong"), 0U) << warnings[0];
}

TEST(Results, EachFrameWithoutAValidPoseIsCountedWithItsReason) {
  VERIFIES("LASSO-MDT-002~1");
  FrameError valid, mismatch, silent;
  valid.told = valid.reported = valid.valid = true;
  mismatch.told = mismatch.reported = true;
  mismatch.reason = PoseReason::kModelMismatch;
  SimulationResult result;
  result.tables.emplace_back().variants.emplace_back().variant.title = "loud";
  result.tables[0].scenario.ranges_m = {4};
  result.tables[0].variants[0].cases.emplace_back().frames = {valid, mismatch, silent, mismatch};
  EXPECT_NE(summary_text(result).find("loud: frames without a valid pose: model_mismatch 2, no packet 1 ("), std::string::npos)
      << summary_text(result);
}

}  // namespace
}  // namespace lasso::mdat
