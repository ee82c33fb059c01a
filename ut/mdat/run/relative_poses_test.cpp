#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "mdat/run/case.hpp"
#include "mdat/run/relative_table.hpp"
#include "mdat/run/simulated_scenario.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const Pose kT_head{normalized(Quat(0.9, 0.1, -0.3, 0.2)), Vec3(0.3, -0.2, 0.5)};   // in the chaser
const Pose kT_port{normalized(Quat(0.7, -0.4, 0.2, 0.5)), Vec3(-0.1, 0.4, 0.9)};   // in the chaser
const Pose kT_point{normalized(Quat(0.6, 0.3, 0.6, -0.4)), Vec3(-6.4, 0.3, 1.2)};  // in the target

// Axes that turn as those of an orbit, far away from all else.
scene::MotionPtr turning_axes() {
  scene::ConstantRates::Setup setup;
  setup.T_parent_pivot = {normalized(Quat(0.5, -0.4, 0.6, 0.3)), Vec3(700, -300, 200)};
  setup.rates = {Vec3(0.002, 0.03, -0.01), Vec3(1, 2, 3)};
  return std::make_shared<scene::ConstantRates>(setup);
}

// A chaser at rest, and a target that turns and drifts before it.
std::shared_ptr<SceneRun> docking_run() {
  scene::ConstantRates::Setup setup;
  setup.T_parent_pivot = {normalized(Quat(0.8, 0.2, 0.5, -0.1)), Vec3(2, -1, 30)};
  setup.rates = {Vec3(0.01, -0.02, 0.005), Vec3(0.05, 0.02, -0.1)};
  const auto node = [](const char* name, const char* parent, const Pose& pose, const scene::MotionPtr& motion) {
    scene::Node result;
    result.name = name;
    result.parent = parent;
    result.T_parent_base = pose;
    result.motion = motion;
    return result;
  };
  const scene::Tree tree(
      "root", {node("target", "root", {}, std::make_shared<scene::ConstantRates>(setup)), node("point", "target", kT_point, nullptr),
               node("chaser", "root", {}, nullptr), node("head", "chaser", kT_head, nullptr), node("port", "chaser", kT_port, nullptr),
               node("local", "root", {}, turning_axes())});
  return std::make_shared<SceneRun>(
      SceneRun{tree, tree.need("target"), tree.need("head"), {}, {}, 0, 0, {}, {}, {{"docking", tree.need("point"), tree.need("port")}}});
}

void set(const Pose& pose, double (&q)[4], double (&p_m)[3]) {
  for (int i = 0; i < 4; ++i) q[i] = pose.q.coeffs()[i];
  for (int i = 0; i < 3; ++i) p_m[i] = pose.p[i];
}

Mat6 covariance_of(test::Generator& random) {
  Mat6 root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = 1e-3 * random.uniform(-1, 1);
  return root * root.transpose() + 1e-7 * Mat6::Identity();
}

// What the component said of one scan: the truth but for a small error, and rates.
struct Said {
  Pose T_sensor_target;
  Mat6 covariance;
  PoseTelemetry packet;
};
Said said_at(const SceneRun& run, TimeUs t_us, test::Generator& random) {
  Said said;
  const scene::MotionState truth = run.target_at(t_us);
  const Vec3 turn = 1e-4 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  said.T_sensor_target = {normalized(exp_so3(turn) * truth.T_a_b.q), truth.T_a_b.p + Vec3(1e-3, -2e-3, 5e-4)};
  said.covariance = covariance_of(random);
  said.packet.valid = 1;
  said.packet.stop = 1;
  said.packet.t_measurement_us = kEpochUs + t_us;
  set(said.T_sensor_target, said.packet.q_sensor_target, said.packet.p_sensor_target_m);
  set(truth.T_a_b, said.packet.filter_q_sensor_target, said.packet.filter_p_sensor_target_m);
  for (int i = 0; i < 3; ++i) {
    said.packet.filter_omega_radps[i] = truth.rates.omega_radps[i];
    said.packet.filter_v_mps[i] = truth.rates.v_mps[i];
  }
  std::size_t term = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) said.packet.covariance[term++] = said.covariance(row, column);
  }
  return said;
}

std::vector<RelativeRun> runs_of(const SceneRun& run, const PoseTelemetry& packet) {
  std::vector<std::uint8_t> telemetry(2000);
  telemetry.resize(encode_pose(packet, PacketHeader{}, Bytes(telemetry.data(), telemetry.size())));
  return relative_runs(run, telemetry);
}

Eigen::Isometry3d isometry(const Pose& pose) { return Eigen::Translation3d(pose.p) * pose.q; }

TEST(RelativePoses, ArePosesOfTheNamedFramesWithTheirLeverArms) {
  VERIFIES("LASSO-SCN-026~1");
  const auto run = docking_run();
  test::Generator random(26);
  for (const TimeUs t_us : {TimeUs{0}, TimeUs{7'300'000}, TimeUs{31'000'000}}) {
    const Said said = said_at(*run, t_us, random);
    const RelativePose pose = runs_of(*run, said.packet).at(0).poses.at(0);
    const Eigen::Isometry3d expected =
        isometry(kT_port).inverse() * isometry(kT_head) * isometry(said.T_sensor_target) * isometry(kT_point);
    EXPECT_LT((isometry(pose.T_in_of).matrix() - expected.matrix()).norm(), 1e-12);
    // The same knowledge, said of other frames: as many sigmas off.
    const double there = nees(pose.T_in_of, pose.truth, pose.covariance);
    EXPECT_NEAR(there, nees(said.T_sensor_target, run->target_at(t_us).T_a_b, said.covariance), 0.01 * there);
    EXPECT_GT(there, 0.1);
    EXPECT_TRUE(pose.valid);
    EXPECT_NEAR(pose.t_s, 1e-6 * static_cast<double>(t_us), 1e-12);
  }
}

// The filter's rates are true, so those of the named frames are the differences of true poses.
TEST(RelativePoses, HaveTheRatesOfTheirOwnOrigins) {
  VERIFIES("LASSO-SCN-026~1");
  const auto run = docking_run();
  test::Generator random(27);
  const TimeUs t_us = 12'000'000;
  const RelativePose pose = runs_of(*run, said_at(*run, t_us, random).packet).at(0).poses.at(0);
  const auto truth_at = [&](TimeUs t) { return run->tree.state(run->relative[0].of, run->relative[0].in, t).T_a_b; };
  const Pose before = truth_at(t_us - 1000), after = truth_at(t_us + 1000);
  EXPECT_LT((pose.rates.v_mps - (after.p - before.p) / 2e-3).norm(), 1e-6);
  EXPECT_LT((pose.rates.omega_radps - log_so3(after.q * before.q.conjugate()) / 2e-3).norm(), 1e-6);
  EXPECT_LT((pose.T_in_of_filtered.p - truth_at(t_us).p).norm(), 1e-9);
}

// From the origin of the port, in axes that turn: the position is turned alone, and the rates are those of an observer who turns with them.
TEST(RelativePoses, AreSaidInOtherAxesAsWell) {
  VERIFIES("LASSO-SCN-032~1");
  const auto run = docking_run();
  run->relative[0].axes = run->tree.need("local");
  test::Generator random(29);
  for (const TimeUs t_us : {TimeUs{0}, TimeUs{12'000'000}}) {
    const Said said = said_at(*run, t_us, random);
    const RelativePose pose = runs_of(*run, said.packet).at(0).poses.at(0);
    const auto R_local_root = [&](TimeUs t) {
      return Mat3(run->tree.state(run->tree.need("local"), 0, t).T_a_b.q.toRotationMatrix().transpose());
    };
    const Eigen::Isometry3d in_port = isometry(kT_port).inverse() * isometry(kT_head) * isometry(said.T_sensor_target) * isometry(kT_point);
    const Mat3 R_local_port = R_local_root(t_us) * kT_port.q.toRotationMatrix();
    EXPECT_LT((pose.T_in_of.p - R_local_port * in_port.translation()).norm(), 1e-11);
    EXPECT_LT((pose.T_in_of.q.toRotationMatrix() - R_local_port * in_port.rotation()).norm(), 1e-12);
    const auto truth_at = [&](TimeUs t) { return runs_of(*run, said_at(*run, t, random).packet).at(0).poses.at(0).truth; };
    const Pose before = truth_at(t_us - 1000), after = truth_at(t_us + 1000);
    EXPECT_LT((pose.rates.v_mps - (after.p - before.p) / 2e-3).norm(), 1e-6);
    EXPECT_LT((pose.rates.omega_radps - log_so3(after.q * before.q.conjugate()) / 2e-3).norm(), 1e-6);
    EXPECT_LT((pose.true_rates.v_mps - pose.rates.v_mps).norm(), 1e-9) << "the filter says the truth here";
    const double there = nees(pose.T_in_of, pose.truth, pose.covariance);
    EXPECT_NEAR(there, nees(said.T_sensor_target, run->target_at(t_us).T_a_b, said.covariance), 0.01 * there);
  }
}

TEST(RelativePoses, FiguresAreOfValidPosesAndTheTableHasAll) {
  VERIFIES("LASSO-SCN-026~1");
  const auto run = docking_run();
  test::Generator random(28);
  Said said = said_at(*run, 1'000'000, random);
  std::vector<RelativeRun> runs = runs_of(*run, said.packet);
  said.packet.valid = 0;
  said.packet.p_sensor_target_m[0] += 5;
  runs[0].poses.push_back(runs_of(*run, said.packet).at(0).poses.at(0));
  const RelativeFigures figures = relative_figures(runs[0]);
  EXPECT_EQ(figures.poses, 2U);
  EXPECT_EQ(figures.valid, 1U);
  EXPECT_NEAR(figures.rms_mm, 1e3 * (runs[0].poses[0].T_in_of.p - runs[0].poses[0].truth.p).norm(), 1e-6);
  const std::string table = relative_csv(runs);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  const auto fields = [&](std::size_t from) {
    return std::count(table.begin() + static_cast<std::ptrdiff_t>(from),
                      table.begin() + static_cast<std::ptrdiff_t>(table.find('\n', from)), ',');
  };
  EXPECT_EQ(fields(0), fields(table.find("docking,")));
  runs[0].poses[0].covariance.setZero();
  const std::string unknown = relative_csv(runs);
  EXPECT_EQ(unknown.find("inf"), std::string::npos) << unknown;
  EXPECT_EQ(std::count(unknown.begin(), unknown.end(), ','), std::count(table.begin(), table.end(), ','));
}

}  // namespace
}  // namespace lasso::mdat
