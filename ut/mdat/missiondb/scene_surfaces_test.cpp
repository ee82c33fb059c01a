#include "mdat/missiondb/scene_surfaces.hpp"

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kSurfaceHead =
    "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'two.toml'\nscale = 2\n[node.body]\ntarget = true\n"
    "[node.camera]\nposition_m = [0, 0, -9]\nsensor = true\n[scenario.s]\n";

class SceneSurfacesTest : public ::testing::Test {
 protected:
  SceneSurfacesTest() {
    folder_.write("two.toml",
                  "[[part]]\nname = 'bus'\nkind = 'box'\nsize = [1, 1, 1]\n[[part]]\nname = 'panel +x'\nkind = 'box'\nsize = [1, 2, "
                  "0.1]\nplace = [{move = [2, 0, 0]}]\n"
                  "[[part]]\nname = 'panel -x'\nkind = 'box'\nsize = [1, 2, 0.1]\nplace = [{move = [-2, 0, 0]}]\n");
  }
  MissionSource load(const std::string& text) {
    MissionSource source = load_mission(folder_.write("m.toml", kSurfaceHead + text));
    load_scene(source, load_target(source));
    return source;
  }
  Folder folder_;
};

TEST_F(SceneSurfacesTest, PartsOfTheTargetAreTakenFromIt) {
  VERIFIES("LASSO-SCN-022~1");
  const MissionSource source = load("[node.panels]\nparent = 'body'\nparts = ['panel*']\n");
  const Mesh target = load_target(source);
  const SceneSurfaces& surfaces = *source.scenarios.at("s").scene->surfaces;
  ASSERT_EQ(surfaces.bodies.size(), 1U);
  EXPECT_EQ(surfaces.bodies[0].mesh.triangles.size(), 24U);
  for (std::size_t i = 0; i < target.triangles.size(); ++i) {
    const double x_m = std::abs(target.vertices[target.triangles[i][0]].x());
    EXPECT_EQ(surfaces.moved[i], x_m > 1.5);  // the panels reach from 3 to 5 m, the bus to 1 m
  }
}

TEST_F(SceneSurfacesTest, OtherBodiesHaveTheirOwnFilesAndScales) {
  VERIFIES("LASSO-SCN-022~1");
  const MissionSource source = load("[node.debris]\nmodel = 'two.toml'\nscale = 3\n");
  const BodySurface& debris = source.scene.surfaces->bodies.at(0);
  EXPECT_EQ(debris.part_names, (std::vector<std::string>{"bus", "panel +x", "panel -x"}));
  double farthest_m = 0;
  for (const Eigen::Vector3d& v : debris.mesh.vertices) farthest_m = std::max(farthest_m, v.x());
  EXPECT_NEAR(farthest_m, 7.5, 1e-12);
  EXPECT_EQ(debris.part_of_triangle.size(), debris.mesh.triangles.size());
  EXPECT_TRUE(source.scene.surfaces->moved.empty());
}

TEST_F(SceneSurfacesTest, ANodeMayBeACloudOfPoints) {
  VERIFIES("LASSO-SCN-033~1");
  folder_.write(
      "two.ply",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n");
  const MissionSource source = load("[node.rock]\npoints = 'two.ply'\nscale = 2\ndisc_radius_m = 0.01\n");
  const BodySurface& rock = source.scene.surfaces->bodies.back();
  EXPECT_EQ(rock.part_names, std::vector<std::string>{"rock"});
  EXPECT_EQ(rock.part_of_triangle.size(), rock.mesh.triangles.size());
  EXPECT_NEAR((rock.mesh.vertices.front() - Eigen::Vector3d(2, 4, 6)).norm(), 0.01 * std::sqrt(M_PI / std::sqrt(3.0)), 1e-12);
  const auto said = [&](const std::string& node) { return mission_error_of([&] { static_cast<void>(load(node)); }); };
  EXPECT_NE(said("[node.a]\ndisc_radius_m = 1\n").find("node.a.disc_radius_m: has no effect without points"), std::string::npos)
      << said("[node.a]\ndisc_radius_m = 1\n");
  folder_.write("none.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n");
  EXPECT_NE(said("[node.a]\npoints = 'none.ply'\n").find("node.a.points: "), std::string::npos);
}

TEST_F(SceneSurfacesTest, EveryNodeThatCannotBeIsNamed) {
  VERIFIES("LASSO-SCN-024~1");
  folder_.write("bad.stl", "solid nothing\nendsolid nothing\n");
  const std::string said = mission_error_of([&] {
    static_cast<void>(
        load("[node.a]\nparts = ['panels*']\n[node.b]\nparts = ['panel +x']\n[node.c]\nparts = 'panel*'\n[node.d]\nmesh = 'bad.stl'\n"));
  });
  EXPECT_NE(said.find("m.toml:15:9: node.a.parts: \"panels*\": the target has no such part; mdat render"), std::string::npos) << said;
  EXPECT_NE(said.find("node.c.parts: \"panel +x\": the part is another node's already"), std::string::npos) << said;
  EXPECT_NE(said.find("node.d.mesh"), std::string::npos) << said;
  const std::string all = mission_error_of([&] { static_cast<void>(load("[node.a]\nparts = ['bus', 'panel*']\n")); });
  EXPECT_NE(all.find("node.a.parts: nothing of the target is left at its own node"), std::string::npos) << all;
}

}  // namespace
}  // namespace lasso::mdat
