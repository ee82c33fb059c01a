#include "mdat/run/ranged_scene.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/run/simulated_scenario.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Eigen::AngleAxisd;

constexpr double kRange_m = 4.25;
constexpr DurationUs kPeriodUs = 200000;

std::vector<double> numbers(test::Generator& random, double most, std::size_t count = 3) {
  std::vector<double> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back(random.uniform(-most, most));
  return list;
}

Scenario random_placed(test::Generator& random, bool centred) {
  Scenario scenario;
  scenario.ranges_m = {kRange_m};
  scenario.tilt_rad = random.uniform(-1.5, 1.5);
  scenario.boresight_rad = random.uniform(-3, 3);
  scenario.roll_rad = random.uniform(-3, 3);
  scenario.offset_m = numbers(random, 1, 2);
  if (!centred) scenario.center_m = numbers(random, 2);
  return scenario;
}

// Of frame 0, by matrices: x up in the image, z away, rolled, tilted, then turned about the boresight.
Mat3 first_attitude(const Scenario& s) {
  const Mat3 x_up = (Mat3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished();
  const Mat3 tilt = AngleAxisd(-s.tilt_rad, Vec3::UnitX()).toRotationMatrix();
  const Mat3 turn = AngleAxisd(s.boresight_rad, Vec3::UnitZ()).toRotationMatrix();
  return turn * tilt * x_up * AngleAxisd(s.roll_rad, Vec3::UnitX()).toRotationMatrix();
}

Mat3 turned_by(const Vec3& rotation_rad) {
  const double angle_rad = rotation_rad.norm();
  const Vec3 axis = rotation_rad / std::max(angle_rad, 1e-300);
  return AngleAxisd(angle_rad, axis).toRotationMatrix();  // of no angle: the identity
}

Quat random_attitude(test::Generator& random) { return Quat(turned_by(Vec3(numbers(random, 2).data()))); }

TimeUs random_time(test::Generator& random) { return static_cast<TimeUs>(std::llround(random.uniform(-10e6, 400e6))); }

// The point center_m is where it is said to be, the attitude is as expected, and the rates are those of the pose.
void expect_state(const sim::Trajectory& trajectory, TimeUs t_us, const Scenario& scenario, const Mat3& R, const Vec3& center_m) {
  const sim::TruthState truth = trajectory.at(kEpochUs + t_us);
  ASSERT_NEAR((truth.T_sensor_target.q.toRotationMatrix() - R).norm(), 0, 1e-12);
  ASSERT_NEAR((truth.T_sensor_target * Vec3(scenario.center_m.data()) - center_m).norm(), 0, 1e-11);
  ASSERT_TRUE(is_valid(truth.T_sensor_target));
  const Pose ray = trajectory.pose_at(kEpochUs + t_us);
  EXPECT_EQ(ray.q.coeffs(), truth.T_sensor_target.q.coeffs()) << "rays see the exact motion";
  EXPECT_EQ(ray.p, truth.T_sensor_target.p);
}

void expect_rates(const sim::Trajectory& trajectory, TimeUs t_us) {
  const auto pose = [&](TimeUs t) { return trajectory.at(kEpochUs + t).T_sensor_target; };
  const Vec6 step = pose_difference(pose(t_us + 1000), pose(t_us - 1000)) / 0.002;
  const Twist rates = trajectory.at(kEpochUs + t_us).rates;
  ASSERT_NEAR((step.head<3>() - rates.omega_radps).norm(), 0, 1e-8);
  ASSERT_NEAR((step.tail<3>() - rates.v_mps).norm(), 0, 1e-5);
}

TEST(RangedScene, StepsTurnATargetThatStandsStillInEachScan) {
  VERIFIES("LASSO-SCN-004~2 LASSO-SIM-005~1");
  test::Generator random(11);
  for (int trial = 0; trial < 20; ++trial) {
    Scenario scenario = random_placed(random, trial % 2 == 0);
    scenario.step_rad = random.uniform(-0.1, 0.1);
    const auto trajectory = make_trajectory(scenario, kRange_m, kEpochUs, kPeriodUs);
    const Vec3 center_m(scenario.offset_m[0], scenario.offset_m[1], kRange_m);
    for (const std::int64_t frame : {-2, 0, 5, 359}) {
      const Mat3 R = first_attitude(scenario) * turned_by(scenario.step_rad * static_cast<double>(frame) * Vec3::UnitX());
      for (const DurationUs in_us : {DurationUs{0}, kPeriodUs - 1}) {
        expect_state(*trajectory, frame * kPeriodUs + in_us, scenario, R, center_m);
        const Twist rates = trajectory->at(kEpochUs + frame * kPeriodUs + in_us).rates;
        ASSERT_EQ(rates.omega_radps.norm() + rates.v_mps.norm(), 0);
      }
    }
  }
}

TEST(RangedScene, SpinAndDriftAreConstantInTheSensorsAxes) {
  VERIFIES("LASSO-SCN-004~2");
  test::Generator random(12);
  for (int trial = 0; trial < 20; ++trial) {
    Scenario scenario = random_placed(random, trial % 2 == 0);
    scenario.spin_radps = numbers(random, 0.1);
    scenario.drift_mps = numbers(random, 0.1);
    const auto trajectory = make_trajectory(scenario, kRange_m, kEpochUs, kPeriodUs);
    for (int i = 0; i < 10; ++i) {
      const TimeUs t_us = random_time(random);
      const double t_s = 1e-6 * static_cast<double>(t_us);
      const Vec3 center_m = Vec3(scenario.offset_m[0], scenario.offset_m[1], kRange_m) + t_s * Vec3(scenario.drift_mps.data());
      expect_state(*trajectory, t_us, scenario, first_attitude(scenario) * turned_by(t_s * Vec3(scenario.spin_radps.data())), center_m);
      expect_rates(*trajectory, t_us);
    }
  }
}

// The range by the cubic that rests at both ends of its time.
double range_at(const Scenario& scenario, double t_s) {
  for (std::size_t i = 1; i < scenario.times_s.size(); ++i) {
    const double u = (t_s - scenario.times_s[i - 1]) / (scenario.times_s[i] - scenario.times_s[i - 1]);
    if (u >= 0 && u < 1) return scenario.ranges_m[i - 1] + (scenario.ranges_m[i] - scenario.ranges_m[i - 1]) * (3 * u * u - 2 * u * u * u);
  }
  return t_s < scenario.times_s.front() ? scenario.ranges_m.front() : scenario.ranges_m.back();
}

TEST(RangedScene, TimesLeadThroughTheRanges) {
  VERIFIES("LASSO-SCN-004~2 LASSO-SIM-035~1");
  test::Generator random(13);
  for (int trial = 0; trial < 20; ++trial) {
    Scenario scenario = random_placed(random, trial % 2 == 0);
    scenario.spin_radps = numbers(random, 0.1);
    if (trial % 3 == 0) scenario.drift_mps = numbers(random, 0.02);
    scenario.times_s = {0, 20, 50, 55, 300};
    scenario.ranges_m = {60, 30, 30, 25, 4};
    const auto trajectory = make_trajectory(scenario, 60, kEpochUs, kPeriodUs);
    for (int i = 0; i < 10; ++i) {
      const TimeUs t_us = random_time(random);
      const double t_s = 1e-6 * static_cast<double>(t_us);
      const Vec3 center_m =
          Vec3(scenario.offset_m[0], scenario.offset_m[1], range_at(scenario, t_s)) + t_s * Vec3(scenario.drift_mps.data());
      expect_state(*trajectory, t_us, scenario, first_attitude(scenario) * turned_by(t_s * Vec3(scenario.spin_radps.data())), center_m);
      expect_rates(*trajectory, t_us);
    }
  }
}

TEST(RangedScene, IsATargetAloneBeforeASensorInTheRoot) {
  VERIFIES("LASSO-SCN-004~2");
  test::Generator random(14);
  const Scenario scenario = random_placed(random, false);
  const auto run = scene_run(scenario, kRange_m, kPeriodUs);
  EXPECT_EQ(run->tree.size(), 2U);
  EXPECT_EQ(run->sensor, 0U);
  EXPECT_TRUE(run->body_nodes.empty() && run->volumes.empty());
  Scenario of_nodes = scenario;
  of_nodes.scene = run;
  EXPECT_EQ(scene_run(of_nodes, 7, kPeriodUs), run) << "a scenario of nodes is the scene itself";
}

// A sensor that stands elsewhere sees the target from there: by matrices, before nodes and before a sensor at rest.
TEST(RangedScene, ASensorElsewhereSeesTheTargetFromThere) {
  VERIFIES("LASSO-SCN-034~1");
  test::Generator random(15);
  for (int trial = 0; trial < 20; ++trial) {
    Scenario scenario = random_placed(random, false);
    scenario.spin_radps = numbers(random, 0.1);
    FurtherSensor sensor;
    sensor.node = "mast";
    sensor.T_sensor_own = Pose{random_attitude(random), Vec3(numbers(random, 1).data())};
    const Eigen::Isometry3d own = Eigen::Translation3d(sensor.T_sensor_own->p) * Eigen::Isometry3d(sensor.T_sensor_own->q);
    const auto plain = scene_run(scenario, kRange_m, kPeriodUs), seen = scene_run_from(scenario, kRange_m, kPeriodUs, sensor);
    const TimeUs t_us = random_time(random);
    const auto as_matrix = [](const Pose& pose) { return Eigen::Translation3d(pose.p) * Eigen::Isometry3d(pose.q); };
    const Eigen::Isometry3d expected = own.inverse() * as_matrix(plain->target_at(t_us).T_a_b);
    EXPECT_LT((as_matrix(seen->target_at(t_us).T_a_b).matrix() - expected.matrix()).norm(), 1e-11);
    scene::Node target, head, mast;
    target.name = "body", head.name = "head", mast.name = "mast";
    target.parent = head.parent = kSceneRoot;
    target.motion = ranged_motion(scenario, kRange_m, kPeriodUs);
    mast.parent = "head";
    mast.T_parent_base = *sensor.T_sensor_own;
    SceneRun run{scene::Tree(kSceneRoot, {target, head, mast}), 1, 2, {}, nullptr, 0, 0, {}, {}, {}};
    scenario.scene = std::make_shared<SceneRun>(run);
    const auto of_nodes = scene_run_from(scenario, kRange_m, kPeriodUs, sensor);
    EXPECT_LT((as_matrix(of_nodes->target_at(t_us).T_a_b).matrix() - expected.matrix()).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace lasso::mdat
