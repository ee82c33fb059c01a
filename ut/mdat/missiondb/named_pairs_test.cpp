#include "mdat/missiondb/named_pairs.hpp"

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// The sensors 0.2 m and 0.1 m off the chaser's origin, turned about its z axis by 73.7 deg; a port on either side.
const std::string kPairScene =
    "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n"
    "[motion.spin]\nkind = 'rates'\nspin_degps = [0, 0, 2]\nposition_m = [0, 0, 0.5]\n"
    "[motion.way]\nkind = 'rates'\nposition_m = [0, 0, -5]\nvelocity_mps = [0, 0, 0.1]\n"
    "[node.body]\ntarget = true\nmotion = 'spin'\n[node.chaser]\nmotion = 'way'\n"
    "[node.camera]\nparent = 'chaser'\nposition_m = [0.2, 0.1, 0]\nquaternion = [0, 0, 0.6, 0.8]\nsensor = true\n"
    "[node.port]\nparent = 'body'\nposition_m = [0.5, 0, 0.1]\n[node.arm]\nparent = 'chaser'\nposition_m = [0, 0, 1]\n"
    "[scenario.s]\n";

std::string pair_named(const std::string& name, const std::string& more = "") {
  return "[relative." + name + "]\nof = 'port'\nin = 'arm'\n" + more;
}

class NamedPairsTest : public ::testing::Test {
 protected:
  NamedPairsTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kPairScene + text)); }
  std::vector<NamedPair> pairs(const std::string& text) { return named_pairs(load(text).scene); }
  std::string problems(const std::string& text) {
    return mission_error_of([&] { static_cast<void>(load(text)); });
  }
  Folder folder_;
};

TEST_F(NamedPairsTest, StandInTheOrderOfTheirNamesWithBothPlaces) {
  VERIFIES("LASSO-LNK-050~1");
  const std::vector<NamedPair> found = pairs(pair_named("late") + pair_named("docking"));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "docking");
  EXPECT_EQ(found[1].name, "late");
  EXPECT_LT((found[0].frame.T_target_of.p - Vec3(0.5, 0, 0.1)).norm(), 1e-12);
  EXPECT_LT((found[0].frame.T_in_sensor.p - Vec3(0.2, 0.1, -1)).norm(), 1e-12);
  EXPECT_LT(found[0].frame.T_in_sensor.q.angularDistance(Quat(0.8, 0, 0, 0.6)), 1e-12);
  EXPECT_TRUE(pairs("").empty());
}

// In the origin of the arm, about which the chaser's axes are the camera's turned back.
TEST_F(NamedPairsTest, AxesCountThatStandStillAgainstTheSensors) {
  VERIFIES("LASSO-LNK-050~1");
  const std::vector<NamedPair> found = pairs(pair_named("dock", "axes = 'camera'\n"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(found[0].frame.T_in_sensor.q.angularDistance(Quat::Identity()), 1e-12);
  EXPECT_LT((found[0].frame.T_in_sensor.p - Quat(0.8, 0, 0, 0.6).conjugate() * Vec3(0.2, 0.1, -1)).norm(), 1e-12);
  EXPECT_TRUE(pairs(pair_named("dock", "axes = 'root'\n")).empty()) << "the component does not know how the chaser turns";
  EXPECT_NE(problems(pair_named("dock", "axes = 'root'\ntelemetry = true\n"))
                .find("relative.dock.telemetry: true: the component does not know how root turns against the sensors"),
            std::string::npos);
}

TEST_F(NamedPairsTest, AreAsManyAsAnImageHolds) {
  VERIFIES("LASSO-LNK-050~1");
  const std::string four = pair_named("a") + pair_named("b") + pair_named("c") + pair_named("d");
  EXPECT_EQ(pairs(four + pair_named("e", "telemetry = false\n")).size(), 4U);
  const std::string said = problems(four + pair_named("e"));
  EXPECT_NE(said.find("relative.e: a flight image has room for 4 pairs of frames: telemetry = false leaves it to the ground"),
            std::string::npos)
      << said;
}

}  // namespace
}  // namespace lasso::mdat
