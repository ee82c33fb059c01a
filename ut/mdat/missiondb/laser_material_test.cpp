#include "mdat/missiondb/laser_material.hpp"

#include "mdat/missiondb/scene_surfaces.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kLitHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'two.toml'\n";

class LaserMaterialTest : public ::testing::Test {
 protected:
  LaserMaterialTest() {
    folder_.write("two.toml",
                  "[[part]]\nname = 'bus'\nkind = 'box'\nsize = [1, 1, 1]\n[[part]]\nname = 'panel'\nkind = 'box'\nsize = [1, 2, 0.1]\n"
                  "place = [{move = [2, 0, 0]}]\n");
    folder_.write("one.toml", "[[part]]\nname = 'mast'\nkind = 'box'\nsize = [1, 1, 1]\n");
  }
  MissionSource load(const std::string& text) {
    MissionSource source = load_mission(folder_.write("m.toml", kLitHead + text));
    mesh_ = load_target(source);
    load_scene(source, mesh_);
    return source;
  }
  Folder folder_;
  Mesh mesh_;
};

TEST_F(LaserMaterialTest, EachTriangleHasWhatItsPartIsMadeOf) {
  VERIFIES("LASSO-SIM-061~1");
  const MissionSource source = load(
      "[sensor.detector]\nreference_electrons = 100\n[material.a]\nparts = 'panel'\npreset = 'solar-cells'\nlaser = 0.33\n"
      "[material.b]\nparts = 'other.mast'\npreset = 'regolith'\n[node.other]\nmodel = 'one.toml'\n");
  ASSERT_EQ(source.target_laser.size(), mesh_.triangles.size());
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const bool panel = mesh_.vertices[mesh_.triangles[i][0]].x() > 1;
    EXPECT_EQ(source.target_laser[i].diffuse, panel ? 0.33 : laser_preset("mli").diffuse);  // a bus is likely of MLI
    EXPECT_EQ(source.target_laser[i].specular, laser_preset(panel ? "solar-cells" : "mli").specular);
  }
  const BodySurface& other = source.scene.surfaces->bodies.at(0);
  ASSERT_EQ(other.laser.size(), other.mesh.triangles.size());
  EXPECT_EQ(other.laser[0].diffuse, laser_preset("regolith").diffuse);
}

TEST_F(LaserMaterialTest, WithoutADetectorThereIsNone) {
  VERIFIES("LASSO-SIM-067~1");
  const MissionSource source = load("[material.a]\nparts = 'panel'\npreset = 'solar-cells'\n");
  EXPECT_TRUE(source.target_laser.empty());
  EXPECT_FALSE(has_detector(source));
}

TEST_F(LaserMaterialTest, EveryPresetSendsBackNoMoreThanComes) {
  VERIFIES("LASSO-SIM-061~1");
  for (const char* name : kMaterialNames) {
    const sim::LaserReflection preset = laser_preset(name);
    EXPECT_LE(preset.diffuse + preset.specular, 1) << name;
    EXPECT_GT(preset.diffuse, 0) << name;
    EXPECT_GT(preset.roughness, 0) << name;
  }
}

}  // namespace
}  // namespace lasso::mdat
