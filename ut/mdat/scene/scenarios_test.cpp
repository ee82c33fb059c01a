// The motions of today's scenarios, said with those of a scene: both are the same.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "mdat/run/simulated_scenario.hpp"
#include "mdat/scene/motion.hpp"
#include "mdat/scene/table_motion.hpp"
#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kRange_m = 4.25;
constexpr DurationUs kPeriodUs = 200000;

std::vector<double> numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Scenario random_scenario(test::Generator& random, ScenarioKind kind, bool centred) {
  Scenario scenario;
  scenario.kind = static_cast<double>(kind);
  scenario.step_rad = random.uniform(-0.1, 0.1);
  scenario.tilt_rad = random.uniform(-1.5, 1.5);
  scenario.boresight_rad = random.uniform(-3, 3);
  scenario.roll_rad = random.uniform(-3, 3);
  scenario.offset_m = {random.uniform(-1, 1), random.uniform(-1, 1)};
  scenario.center_m = numbers(centred ? Vec3::Zero() : random_vector(random, 2));
  scenario.spin_radps = numbers(random_vector(random, 0.1));
  scenario.drift_mps = numbers(random_vector(random, 0.1));
  scenario.times_s = {0, 20, 50, 55, 300};
  scenario.ranges_m = {60, 30, 30, 25, 4};
  return scenario;
}

// Where the target's centre is at the epoch.
Pose start_of(const Scenario& scenario) {
  const Quat attitude = sim::upright_attitude(scenario.tilt_rad, scenario.boresight_rad);
  return {normalized(attitude * exp_so3(scenario.roll_rad * Vec3::UnitX())), Vec3(scenario.offset_m[0], scenario.offset_m[1], kRange_m)};
}

Vec3 spin_sensor(const Scenario& scenario) { return rotate(start_of(scenario).q, Vec3(scenario.spin_radps.data())); }

MotionPtr with_centre(MotionPtr motion, const Scenario& scenario) {
  return std::make_shared<Chain>(std::move(motion), std::make_shared<Still>(Pose{Quat::Identity(), -Vec3(scenario.center_m.data())}));
}

// The largest difference of pose and rates at random times, before and after the epoch.
double largest_difference(const Scenario& scenario, const Motion& motion, test::Generator& random) {
  const auto trajectory = make_trajectory(scenario, kRange_m, kEpochUs, kPeriodUs);
  double largest = 0;
  for (int i = 0; i < 40; ++i) {
    const TimeUs t_us = random_time_us(random, -10, 400);
    const sim::TruthState expected = trajectory->at(kEpochUs + t_us);
    const MotionState state = motion.at(t_us);
    largest = std::max(largest, (state.T_a_b.q.coeffs() - expected.T_sensor_target.q.coeffs()).norm());
    largest = std::max(largest, (state.T_a_b.p - expected.T_sensor_target.p).norm());
    largest = std::max(largest, rate_error(state.rates, expected.rates));
  }
  return largest;
}

TEST(Scenarios, StepsAreThePapersToTheBit) {
  VERIFIES("LASSO-SCN-004~1");
  test::Generator random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const Scenario scenario = random_scenario(random, ScenarioKind::kPaper, trial % 2 == 0);
    const auto steps = std::make_shared<Steps>(Steps::Setup{start_of(scenario), Vec3::UnitX(), scenario.step_rad, kPeriodUs});
    ASSERT_EQ(largest_difference(scenario, *with_centre(steps, scenario), random), 0);
  }
}

TEST(Scenarios, ConstantRatesAreTheSpinsToTheBit) {
  VERIFIES("LASSO-SCN-004~1");
  test::Generator random(12);
  for (int trial = 0; trial < 20; ++trial) {
    const Scenario scenario = random_scenario(random, ScenarioKind::kSpin, trial % 2 == 0);
    const Twist rates{spin_sensor(scenario), Vec3(scenario.drift_mps.data())};
    ASSERT_EQ(largest_difference(scenario, ConstantRates({start_of(scenario), rates, Vec3(scenario.center_m.data())}), random), 0);
  }
}

// The ranges as a table at rest in each of its rows, and the turn from it on.
TEST(Scenarios, ATableAtRestInItsRowsIsTheApproachAndThePass) {
  VERIFIES("LASSO-SCN-006~1");
  test::Generator random(13);
  for (int trial = 0; trial < 20; ++trial) {
    const Scenario scenario = random_scenario(random, trial < 10 ? ScenarioKind::kApproach : ScenarioKind::kPass, trial % 2 == 0);
    MotionTable table;
    table.times_s = scenario.times_s;
    for (const double range_m : scenario.ranges_m) table.positions_m.emplace_back(scenario.offset_m[0], scenario.offset_m[1], range_m);
    table.velocities_mps.assign(table.times_s.size(), Vec3::Zero());
    const Pose at_epoch{start_of(scenario).q, Vec3::Zero()};
    const auto turn = std::make_shared<ConstantRates>(ConstantRates::Setup{at_epoch, {spin_sensor(scenario), Vec3::Zero()}});
    const auto motion = with_centre(std::make_shared<Chain>(std::make_shared<TableMotion>(table), turn), scenario);
    ASSERT_LT(largest_difference(scenario, *motion, random), 1e-12);
  }
}

}  // namespace
}  // namespace lasso::mdat::scene
