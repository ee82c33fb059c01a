#include "mdat/trial/trial_light.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(TrialLight, TakesThePlaceOfTheMissionsLight) {
  VERIFIES("LASSO-STE-014~1");
  StereoSource source;
  source.earthshine = 0;
  source.lamp_Wpsr = 5;
  source.f_number = 4;
  for (const TrialLight& light : trial_lights()) {
    const StereoSource lit = lit_by(light, source);
    EXPECT_EQ(lit.sun, light.sun) << light.name;
    EXPECT_EQ(lit.earth, light.earth);
    EXPECT_EQ(lit.lamp_Wpsr, light.lamp_Wpsr);
    EXPECT_EQ(lit.earthshine, 1);
    EXPECT_EQ(lit.f_number, 4) << "the head stays";
  }
}

TEST(TrialLight, IsChosenByName) {
  VERIFIES("LASSO-STE-014~1");
  EXPECT_EQ(chosen_lights({}).size(), trial_lights().size());
  const std::vector<TrialLight> two = chosen_lights({"lamp", "side_on"});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].name, "side_on");
  EXPECT_EQ(two[1].name, "lamp");
  try {
    static_cast<void>(chosen_lights({"lamb"}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--lights lamb: expected one of sun_behind, over_shoulder"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace lasso::mdat
