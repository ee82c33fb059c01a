#include "mdat/scene/tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mdat/scene/table_motion.hpp"
#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

Node node(const std::string& name, const std::string& parent, const Pose& T_parent_base = {}, MotionPtr motion = nullptr) {
  Node result;
  result.name = name;
  result.parent = parent;
  result.T_parent_base = T_parent_base;
  result.motion = std::move(motion);
  return result;
}

MotionPtr random_motion(test::Generator& random) {
  const Pose pose = random_pose(random, 2);
  const Twist rates = random_rates(random, 0.2, 0.1);
  return std::make_shared<ConstantRates>(ConstantRates::Setup{pose, rates, random_vector(random, 1)});
}

// Nodes 1 to 9 in the root, number 0, or in each other; some of them still.
std::vector<Node> random_nodes(test::Generator& random) {
  std::vector<Node> nodes;
  for (std::size_t i = 1; i <= 9; ++i) {
    const std::size_t parent = random.below(i);
    const Pose base = random_pose(random, 3);
    nodes.push_back(node("n" + std::to_string(i), parent == 0 ? "root" : "n" + std::to_string(parent), base));
    if (random.below(3) > 0) nodes.back().motion = random_motion(random);
  }
  return nodes;
}

Eigen::Matrix4d matrix_of(const Pose& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = pose.q.toRotationMatrix();
  m.topRightCorner<3, 1>() = pose.p;
  return m;
}

// In the root, by matrices, parent after parent.
Eigen::Matrix4d in_root(const std::vector<Node>& nodes, const std::string& name, TimeUs t_us) {
  for (const Node& each : nodes) {
    if (each.name != name) continue;
    const Pose moving = each.motion ? each.motion->at(t_us).T_a_b : Pose{};
    return in_root(nodes, each.parent, t_us) * matrix_of(each.T_parent_base) * matrix_of(moving);
  }
  return Eigen::Matrix4d::Identity();
}

TEST(Tree, PosesAreProductsOfMatricesAndRatesTheirDifferences) {
  VERIFIES("LASSO-SCN-013~1");
  test::Generator random(91);
  for (int trial = 0; trial < 15; ++trial) {
    const std::vector<Node> nodes = random_nodes(random);
    const Tree tree("root", nodes);
    ASSERT_EQ(tree.size(), 10U);
    const TimeUs t_us = random_time_us(random, -20, 20);
    for (std::size_t a = 0; a < tree.size(); ++a) {
      const std::size_t b = random.below(tree.size());
      const MotionState found = tree.state(a, b, t_us);
      const Eigen::Matrix4d expected = in_root(nodes, tree.name(b), t_us).inverse() * in_root(nodes, tree.name(a), t_us);
      ASSERT_NEAR((matrix_of(found.T_a_b) - expected).norm(), 0, 1e-11);
      const auto pose_at = [&](TimeUs t) { return tree.state(a, b, t).T_a_b; };
      ASSERT_LT(rate_error(found.rates, difference_rates(pose_at, t_us)), 1e-7);
      const std::size_t c = random.below(tree.size());
      const MotionState around = tree.state(c, b, t_us) * tree.state(a, c, t_us);
      ASSERT_NEAR((matrix_of(around.T_a_b) - expected).norm(), 0, 1e-11);
      ASSERT_LT(rate_error(around.rates, found.rates), 1e-10);
    }
  }
}

// A lens on a chaser, a port on a target, both in orbit: what the lens sees of the port is not rounded as the orbit's numbers are.
TEST(Tree, WhatTwoNodesShareIsNotRounded) {
  VERIFIES("LASSO-SCN-013~1");
  test::Generator random(92);
  const Pose far{random_attitude(random), Vec3(7e6, 1e6, -3e6)};
  const Pose lens = random_pose(random, 1), lamp = random_pose(random, 1);
  const auto flight = std::make_shared<ConstantRates>(ConstantRates::Setup{far, {Vec3(0, 0, 1e-3), Vec3(7e3, 0, 0)}});
  const Tree tree("earth", {node("chaser", "earth", {}, flight), node("lens", "chaser", lens), node("lamp", "chaser", lamp)});
  const MotionState seen = tree.state(tree.need("lamp"), tree.need("lens"), 12'345'678);
  EXPECT_NEAR(pose_difference(seen.T_a_b, inverse(lens) * lamp).norm(), 0, 1e-14);
  EXPECT_EQ(rate_error(seen.rates, Twist{}), 0);
}

TEST(Tree, ANodePointsToAnotherThatMoves) {
  VERIFIES("LASSO-SCN-012~1");
  test::Generator random(93);
  for (int trial = 0; trial < 20; ++trial) {
    Node chaser = node("chaser", "orbit", random_pose(random, 20), random_motion(random));
    chaser.towards = "port";
    chaser.pointing = {Vec3(0.6, 0, 0.8), Vec3(0, -1, 0), Vec3::UnitZ()};
    const Node body = node("target", "orbit", random_pose(random, 5), random_motion(random));
    const Tree tree("orbit",
                    {node("lens", "chaser", random_pose(random, 1)), chaser, body, node("port", "target", random_pose(random, 1))});
    const std::size_t number = tree.need("chaser"), port = tree.need("port");
    const TimeUs t_us = random_time_us(random, -20, 20);
    const Vec3 seen = tree.state(port, number, t_us).T_a_b.p;
    ASSERT_NEAR((seen.normalized() - chaser.pointing.axis_node).norm(), 0, 1e-12) << "the port is on the axis";
    const Quat in_base = chaser.T_parent_base.q.conjugate() * tree.state(number, 0, t_us).T_a_b.q;
    const Vec3 way = in_base * chaser.pointing.axis_node;
    ASSERT_NEAR(way.cross(chaser.pointing.up_base).dot(in_base * chaser.pointing.up_node), 0, 1e-12) << "the roll is the nearest one";
    const Pose position = chaser.T_parent_base * chaser.motion->at(t_us).T_a_b;
    ASSERT_NEAR((tree.state(number, 0, t_us).T_a_b.p - position.p).norm(), 0, 1e-12) << "where its motion has it";
    for (const std::size_t of : {number, tree.need("lens")}) {
      const auto pose_at = [&](TimeUs t) { return tree.state(of, port, t).T_a_b; };
      const Twist expected = difference_rates(pose_at, t_us, 300);
      ASSERT_LT(rate_error(tree.state(of, port, t_us).rates, expected) / (1 + expected.v_mps.norm()), 1e-6);
    }
  }
}

TEST(Tree, FindsNodesByTheirNames) {
  VERIFIES("LASSO-SCN-013~1");
  const Tree tree("orbit", {node("chaser", "orbit"), node("docking_port", "chaser")});
  EXPECT_EQ(tree.find("orbit"), 0U);
  EXPECT_EQ(tree.name(tree.need("docking_port")), "docking_port");
  EXPECT_EQ(tree.find("dock"), std::nullopt);
  EXPECT_EQ(problems_of([&] { tree.need("docking_prot"); }),
            "scene: frame: \"docking_prot\": there is no such node; did you mean docking_port?");
}

// A covariance of small errors, and what becomes of them: numerically, by poses that differ by each of them.
Mat6 numerically(const Mat6& covariance, const Pose& pose, const std::function<Pose(const Pose&)>& map) {
  Mat6 jacobian;
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 6; ++i) {
    const auto with = [&](double error) {
      const Vec3 rotation = i < 3 ? Vec3(error * Vec3::Unit(i)) : Vec3(Vec3::Zero());
      const Vec3 translation = i < 3 ? Vec3(Vec3::Zero()) : Vec3(error * Vec3::Unit(i - 3));
      return map(Pose{exp_so3(rotation) * pose.q, pose.p + translation});
    };
    jacobian.col(i) = pose_difference(with(kStep), with(-kStep)) / (2 * kStep);
  }
  return jacobian * covariance * jacobian.transpose();
}

TEST(Covariance, IsThatOfThePoseInTheOtherFrame) {
  VERIFIES("LASSO-SCN-014~1");
  test::Generator random(94);
  for (int trial = 0; trial < 20; ++trial) {
    Mat6 root;
    for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = random.normal();
    const Mat6 covariance = root * root.transpose();
    const Pose pose = random_pose(random, 5), other = random_pose(random, 5);
    const auto compare = [&](const Mat6& found, const std::function<Pose(const Pose&)>& map) {
      EXPECT_LT((found - numerically(covariance, pose, map)).norm() / found.norm(), 1e-8);
    };
    compare(covariance_in_frame(covariance, other), [&](const Pose& T_a_b) { return other * T_a_b; });
    compare(covariance_of_point(covariance, pose, other), [&](const Pose& T_a_b) { return T_a_b * other; });
    compare(covariance_of_inverse(covariance, pose), [&](const Pose& T_a_b) { return inverse(T_a_b); });
  }
}

// Rays ask a quick motion itself, and all others by a look-up.
TEST(Tree, KnowsBetweenWhichNodesAllIsQuick) {
  VERIFIES("LASSO-SCN-025~1");
  test::Generator random(51);
  MotionTable rows;
  rows.times_s = {0, 1};
  rows.positions_m = {Vec3::Zero(), Vec3::UnitX()};
  std::vector<Node> nodes{node("turns", "root", {}, random_motion(random)), node("on", "turns"),
                          node("slow", "root", {}, std::make_shared<TableMotion>(rows)), node("rests", "slow")};
  nodes.push_back(node("points", "root", {Quat::Identity(), Vec3(1, 2, 3)}));
  nodes.back().towards = "on";
  const Tree tree("root", nodes);
  EXPECT_TRUE(tree.is_quick(tree.need("on"), 0));
  EXPECT_TRUE(tree.is_quick(0, tree.need("on")));
  EXPECT_FALSE(tree.is_quick(tree.need("on"), tree.need("rests")));
  EXPECT_TRUE(tree.is_quick(tree.need("slow"), tree.need("rests"))) << "both move alike";
  EXPECT_FALSE(tree.is_quick(tree.need("points"), 0));
}

}  // namespace
}  // namespace lasso::mdat::scene
