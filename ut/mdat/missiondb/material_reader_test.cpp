#include "mdat/missiondb/material_reader.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/scene_surfaces.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kMaterialHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'two.toml'\n";  // 6 lines

class MaterialReaderTest : public ::testing::Test {
 protected:
  MaterialReaderTest() {
    folder_.write("two.toml",
                  "[[part]]\nname = 'bus'\nkind = 'box'\nsize = [1, 1, 1]\n[[part]]\nname = 'panel'\nkind = 'box'\nsize = [1, 2, 0.1]\n"
                  "place = [{move = [2, 0, 0]}]\n");
  }
  MissionSource load(const std::string& text) {
    MissionSource source = load_mission(folder_.write("m.toml", kMaterialHead + text));
    load_scene(source, load_target(source));
    return source;
  }
  void expect_problem(const std::string& text, const std::string& expected) {
    const std::string said = mission_error_of([&] { static_cast<void>(load(text)); });
    EXPECT_NE(said.find(expected), std::string::npos) << "got: " << said << "\nexpected: " << expected;
  }
  Folder folder_;
};

TEST_F(MaterialReaderTest, ReadsAPresetAndWhatDiffersFromIt) {
  VERIFIES("LASSO-PIC-018~1");
  const MissionSource source = load(
      "[material.shroud]\nparts = ['bus']\npreset = 'silver-teflon'\nroughness = 0.3\ntilt_deg = 2\n"
      "[material.wing]\nparts = 'pan*'\npreset = 'solar-cells'\ndiffuse = [0.1, 0.2, 0.3]\nspecular = [0, 0.1, 0.2]\n");
  ASSERT_EQ(source.materials.size(), 2U);
  EXPECT_EQ(source.materials[0].preset, "silver-teflon");
  EXPECT_EQ(source.materials[0].roughness, 0.3);
  EXPECT_NEAR(source.materials[0].tilt_rad.value_or(0), 2 * kRadPerDeg, 1e-15);
  EXPECT_TRUE(source.materials[0].diffuse.empty());
  EXPECT_EQ(source.materials[1].diffuse, (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(source.materials[1].specular, (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_FALSE(source.materials[1].roughness.has_value());
}

TEST_F(MaterialReaderTest, ReadsWhatLasersSee) {
  VERIFIES("LASSO-SIM-061~1");
  const MissionSource source =
      load("[material.a]\nparts = 'bus'\npreset = 'mli'\nlaser = 0.3\nlaser_specular = 0.4\nlaser_roughness = 0.2\n");
  EXPECT_EQ(source.materials[0].laser, 0.3);
  EXPECT_EQ(source.materials[0].laser_specular, 0.4);
  EXPECT_EQ(source.materials[0].laser_roughness, 0.2);
  expect_problem("[material.a]\nparts = 'bus'\npreset = 'mli'\nlaser = 0.5\n",
                 "m.toml:10:9: material.a.laser: 0.5: laser 0.5 and laser_specular 0.71: more light would leave than comes");
}

TEST_F(MaterialReaderTest, EveryProblemIsToldWithItsPlace) {
  VERIFIES("LASSO-PIC-018~1");
  expect_problem("[material.a]\nparts = 'bus'\npreset = 'gold'\n", "m.toml:9:10: material.a.preset: 'gold': expected one of");
  expect_problem("[material.a]\npreset = 'mli'\n", "material.a.parts: is missing");
  expect_problem("[material.a]\nparts = 'bus'\npreset = 'mli'\ndiffuse = [1, 1, 1]\nspecular = [0.1, 0, 0]\n",
                 "material.a.specular: 0.1: with the diffuse 1 more light");
  expect_problem("[material.a]\nparts = 'bus'\npreset = 'mli'\ndiffuse = [1, 1, 1]\n", "expected diffuse and specular, or none of them");
  expect_problem("[material.a]\nparts = 'panels'\npreset = 'mli'\n[material.b]\nparts = ['bus', 'b*']\npreset = 'mli'\n",
                 "m.toml:8:9: material.a.parts: \"panels\": there is no such part; did you mean panel?");
  expect_problem("[material.a]\nparts = 'panels'\npreset = 'mli'\n[material.b]\nparts = ['bus', 'b*']\npreset = 'mli'\n",
                 "material.b.parts: \"b*\": bus is of [material.b] already");
}

}  // namespace
}  // namespace lasso::mdat
