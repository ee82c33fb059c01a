#include "mdat/scene/tree_check.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

// Each node in a line of its own, from 10 on.
struct Scene {
  std::vector<Node> nodes;

  Scene& add(const std::string& name, const std::string& parent, const std::string& towards = "") {
    Node node;
    node.name = name;
    node.parent = parent;
    node.towards = towards;
    node.place = {"s.toml", 10 + static_cast<int>(nodes.size()), 1};
    nodes.push_back(node);
    return *this;
  }
  std::string problems() const {
    return problems_of([&] { Tree tree("orbit", nodes); });
  }
};

TEST(TreeCheck, SaysEveryProblemOfNamesParentsAndPosesAtOnce) {
  VERIFIES("LASSO-SCN-015~1");
  Scene scene;
  scene.add("chaser", "orbit").add("lens", "chasr").add("chaser", "orbit").add("", "orbit").add("orbit", "orbit").add("port", "x", "lense");
  scene.nodes[1].T_parent_base.q = Quat(0, 0, 0, 0);
  scene.nodes[5].pointing.up_node = Vec3::UnitZ();
  EXPECT_EQ(scene.problems(),
            "s.toml:11:1: lens, parent: \"chasr\": there is no such node; did you mean chaser?\n"
            "s.toml:11:1: lens, pose: is not a pose: expected finite numbers and a quaternion of unit length\n"
            "s.toml:12:1: chaser, name: is another node's, in line 10: every node has a name of its own\n"
            "s.toml:13:1: name: is empty: every node has a name of its own\n"
            "s.toml:14:1: orbit, name: is the root's: give the node another name\n"
            "s.toml:15:1: port, parent: \"x\": there is no such node\n"
            "s.toml:15:1: port, towards: \"lense\": there is no such node; did you mean lens?\n"
            "s.toml:15:1: port, up: lies along the axis: expected another direction of the node, best at right angles");
}

TEST(TreeCheck, TellsEachCircleOfParentsOnce) {
  VERIFIES("LASSO-SCN-015~1");
  Scene scene;
  scene.add("a", "c").add("b", "a").add("c", "b").add("d", "d").add("e", "a").add("f", "orbit");
  EXPECT_EQ(scene.problems(),
            "s.toml:10:1: a, parent: \"a\" in \"c\" in \"b\" in \"a\": is a circle: one of them has to stand in another node, or the root\n"
            "s.toml:13:1: d, parent: \"d\" in \"d\": is a circle: one of them has to stand in another node, or the root");
}

TEST(TreeCheck, RefusesANodeThatPointsToWhatItMoves) {
  VERIFIES("LASSO-SCN-015~1");
  const auto circle = [](int line, const std::string& name, const std::string& towards) {
    return "s.toml:" + std::to_string(line) + ":1: " + name + ", towards: \"" + towards +
           "\": moves with this node, or points to it: point to a node that does not, such as one at the same place without an attitude "
           "law";
  };
  EXPECT_EQ(Scene().add("a", "orbit", "a").problems(), circle(10, "a", "a"));
  EXPECT_EQ(Scene().add("a", "orbit", "lens").add("b", "a").add("lens", "b").problems(), circle(10, "a", "lens"));
  EXPECT_EQ(Scene().add("a", "orbit", "port").add("b", "orbit", "a").add("port", "b").problems(),
            circle(10, "a", "port") + "\n" + circle(11, "b", "a"));
  EXPECT_EQ(Scene().add("a", "orbit", "orbit").add("b", "a", "a").add("c", "orbit", "b").problems(), "") << "parents may be pointed to";
}

}  // namespace
}  // namespace lasso::mdat::scene
