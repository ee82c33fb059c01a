#include "mdat/render/material.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mdat/missiondb/material_source.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Share of perpendicular light that is reflected, over the channels; that of solar cells with the lines between them.
double reflectance(const Material& material) {
  const double lines = material.grid_pitch > 0 ? 2 * kGridLine - kGridLine * kGridLine : 0;
  const Rgb diffuse = material.reflection.diffuse * (1 - lines) + lines * kGridReflectance;
  return (diffuse + material.reflection.specular).mean();
}

TEST(Material, EveryNameOfAMissionIsAPreset) {
  VERIFIES("LASSO-PIC-018~1");
  EXPECT_EQ(material_presets().size(), kMaterialNames.size());
  for (const char* name : kMaterialNames) EXPECT_NE(material_preset(name), nullptr) << name;
}

TEST(Material, PresetsReflectWhatTheirSourcesDoNotAbsorb) {
  VERIFIES("LASSO-PIC-007~1");
  std::set<std::string> names;
  for (const Material& preset : material_presets()) {
    EXPECT_NEAR(reflectance(preset), 1 - preset.solar_absorptance, 0.01) << preset.name;
    EXPECT_LE((preset.reflection.diffuse + preset.reflection.specular).maxCoeff(), 1) << preset.name;
    EXPECT_GT(preset.reflection.roughness, 0) << preset.name;
    names.insert(preset.name);
    EXPECT_EQ(material_preset(preset.name), &preset);
  }
  EXPECT_EQ(names.size(), material_presets().size());
  for (const char* asked : {"silver-teflon", "aluminium-foil", "mli", "solar-cells", "white-paint", "black-anodised"})
    EXPECT_EQ(names.count(asked), 1U) << asked;
  EXPECT_EQ(material_preset("gold"), nullptr);
}

TEST(Material, IsGuessedFromTheNamesOfParts) {
  VERIFIES("LASSO-PIC-007~1");
  EXPECT_STREQ(likely_material("solar array +y").name, "solar-cells");
  EXPECT_STREQ(likely_material("wing 2, panel 1").name, "solar-cells");
  EXPECT_STREQ(likely_material("wing 2, spar").name, "black-anodised");
  EXPECT_STREQ(likely_material("Bus").name, "mli");
  EXPECT_STREQ(likely_material("body").name, "silver-teflon");
  EXPECT_STREQ(likely_material("dish 1, reflector").name, "white-paint");
  EXPECT_STREQ(likely_material("rock").name, "regolith");
  EXPECT_STREQ(likely_material("what is it?").name, "white-paint");
}

}  // namespace
}  // namespace lasso::mdat
