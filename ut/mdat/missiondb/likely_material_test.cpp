#include "mdat/missiondb/likely_material.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(LikelyMaterial, APartsNameTellsWhatItIsMadeOf) {
  VERIFIES("LASSO-SIM-061~1");
  EXPECT_STREQ(likely_material_name("Solar Array +y"), "solar-cells");
  EXPECT_STREQ(likely_material_name("wing 2, spar"), "black-anodised");
  EXPECT_STREQ(likely_material_name("what is it?"), "white-paint");
}

}  // namespace
}  // namespace lasso::mdat
