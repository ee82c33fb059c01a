#include "mdat/scene/table_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

// A motion with all derivatives, which no table meets exactly: a turn about a pivot on another turn.
Chain smooth_motion(test::Generator& random) {
  const auto draw = [&] {
    const Pose pose = random_pose(random, 1);
    const Twist rates = random_rates(random, 0.15, 0.1);
    return std::make_shared<ConstantRates>(ConstantRates::Setup{pose, rates, random_vector(random, 1)});
  };
  const auto outer = draw();
  return {outer, draw()};
}

MotionTable sampled(const Motion& motion, double step_s, int rows, bool with_rates) {
  MotionTable table;
  for (int i = 0; i < rows; ++i) {
    const double t_s = step_s * i;
    const MotionState state = motion.at(std::llround(1e6 * t_s));
    table.times_s.push_back(t_s);
    table.positions_m.push_back(state.T_a_b.p);
    table.attitudes.push_back(state.T_a_b.q);
    if (i % 3 == 1) table.attitudes.back().coeffs() *= -1;  // the same attitude
    if (!with_rates) continue;
    table.velocities_mps.push_back(state.rates.v_mps);
    table.omegas_radps.push_back(state.rates.omega_radps);
  }
  return table;
}

// Largest error of pose (m, rad) and of rates over the inner rows.
std::pair<double, double> errors(const Motion& table, const Motion& truth, double until_s) {
  double pose = 0, rates = 0;
  for (int i = 0; i < 400; ++i) {
    const TimeUs t_us = std::llround(1e6 * until_s * (0.2 + 0.6 * i / 400));
    const MotionState found = table.at(t_us), expected = truth.at(t_us);
    pose = std::max(pose, pose_difference(found.T_a_b, expected.T_a_b).norm());
    rates = std::max(rates, rate_error(found.rates, expected.rates));
  }
  return {pose, rates};
}

// Rows twice as close: with rates the error is 16 times smaller, and that of the rates 8 times; without rates 8 and 4 times.
TEST(TableMotion, ConvergesToTheMotionThatItWasTakenFrom) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(31);
  for (const bool with_rates : {true, false}) {
    const Chain truth = smooth_motion(random);
    const auto [coarse, coarse_rates] = errors(TableMotion(sampled(truth, 1.0, 21, with_rates)), truth, 20);
    const auto [fine, fine_rates] = errors(TableMotion(sampled(truth, 0.5, 41, with_rates)), truth, 20);
    const double order = with_rates ? 4 : 3;
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.35) << with_rates;
    EXPECT_NEAR(std::log2(coarse_rates / fine_rates), order - 1, 0.35) << with_rates;
    EXPECT_LT(fine, with_rates ? 1e-4 : 2e-3);
  }
}

TEST(TableMotion, MeetsItsRowsAndTurnsAndMovesByItsOwnRates) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(32);
  for (const bool with_rates : {true, false}) {
    const Chain truth = smooth_motion(random);
    const TableMotion motion(sampled(truth, 2.0, 9, with_rates));
    EXPECT_EQ(motion.begin_s(), 0);
    EXPECT_EQ(motion.end_s(), 16);
    for (int trial = 0; trial < 40; ++trial) {
      const TimeUs t_us = random_time_us(random, 0.01, 15.99);
      ASSERT_LT(rate_error(motion, t_us), 1e-8) << t_us;
    }
    for (TimeUs t_us = 0; t_us < 16'000'000; t_us += 2'000'000) {
      EXPECT_LT(pose_difference(motion.at(t_us).T_a_b, truth.at(t_us).T_a_b).norm(), 1e-12);
      const TimeUs before_us = t_us > 0 ? t_us - 1 : 0;
      EXPECT_LT(rate_error(motion.at(before_us).rates, motion.at(t_us).rates), 1e-5) << "a jump at a row";
      EXPECT_LT(rate_error(motion.at(t_us).rates, truth.at(t_us).rates), with_rates ? 1e-12 : 0.1);
    }
  }
}

TEST(TableMotion, StaysBeforeItsFirstRowAndFromItsLastOneOn) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(33);
  const Chain truth = smooth_motion(random);
  const TableMotion motion(sampled(truth, 1.0, 5, true));
  for (const auto& [t_us, row_us] :
       {std::pair<TimeUs, TimeUs>{-1, 0}, {-900'000'000, 0}, {4'000'000, 4'000'000}, {5'000'000'000, 4'000'000}}) {
    EXPECT_LT(pose_difference(motion.at(t_us).T_a_b, truth.at(row_us).T_a_b).norm(), 1e-12) << t_us;
    EXPECT_EQ(rate_error(motion.at(t_us).rates, Twist{}), 0);
  }
  const TableMotion single(sampled(truth, 1.0, 1, false));
  EXPECT_LT(pose_difference(single.at(7).T_a_b, truth.at(0).T_a_b).norm(), 1e-12);
}

TEST(TableMotion, OfPositionsAloneKeepsTheParentsAxesAndOfAttitudesAloneItsOrigin) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(34);
  const Chain truth = smooth_motion(random);
  MotionTable positions = sampled(truth, 1.0, 9, true), attitudes = positions;
  const TableMotion both(positions);
  positions.attitudes.clear();
  positions.omegas_radps.clear();
  attitudes.positions_m.clear();
  attitudes.velocities_mps.clear();
  const TableMotion moves(positions), turns(attitudes);
  for (int trial = 0; trial < 20; ++trial) {
    const TimeUs t_us = random_time_us(random, -1, 9);
    EXPECT_EQ(moves.at(t_us).T_a_b.q.coeffs(), Quat::Identity().coeffs());
    EXPECT_EQ(turns.at(t_us).T_a_b.p, Vec3::Zero());
    const MotionState sum = moves.at(t_us) * turns.at(t_us);
    EXPECT_EQ(pose_difference(sum.T_a_b, both.at(t_us).T_a_b).norm(), 0);
    EXPECT_EQ(rate_error(sum.rates, both.at(t_us).rates), 0);
  }
}

// A circular orbit of 92 minutes by rows a minute apart: the cubic is off by decimetres, the polynomials that orbit files ask for are not.
TEST(TableMotion, HigherDegreesMeetAnOrbit) {
  VERIFIES("LASSO-SCN-005~1");
  constexpr double kRadius_m = 6.771e6, kRate_radps = 1.133e-3;
  const auto at = [](double t_s) { return Vec3(kRadius_m * std::cos(kRate_radps * t_s), kRadius_m * std::sin(kRate_radps * t_s), 0); };
  MotionTable table;
  for (int i = 0; i < 20; ++i) {
    table.times_s.push_back(60.0 * i);
    table.positions_m.push_back(at(60.0 * i));
    table.velocities_mps.push_back(kRate_radps * Vec3(-table.positions_m.back().y(), table.positions_m.back().x(), 0));
  }
  const auto worst_m = [&](Interpolation interpolation, int degree) {
    table.interpolation = interpolation;
    table.degree = degree;
    const TableMotion motion(table);
    double worst = 0;
    for (TimeUs t_us = 0; t_us < 1'140'000'000; t_us += 7'123'457) {
      worst = std::max(worst, (motion.at(t_us).T_a_b.p - at(to_seconds(t_us))).norm());
      EXPECT_LT(rate_error(motion, t_us + 10000), 1e-4);
    }
    return worst;
  };
  EXPECT_NEAR(worst_m(Interpolation::kHermite, 3), kRadius_m * std::pow(60 * kRate_radps, 4) / 384, 0.01);
  EXPECT_LT(worst_m(Interpolation::kHermite, 7), 1e-6);
  EXPECT_EQ(worst_m(Interpolation::kHermite, 6), worst_m(Interpolation::kHermite, 7)) << "rounded up to whole rows";
  EXPECT_NEAR(worst_m(Interpolation::kLagrange, 1), kRadius_m * std::pow(60 * kRate_radps, 2) / 8, 1);
  EXPECT_LT(worst_m(Interpolation::kLagrange, 9), 1e-3);
}

std::string problems_of_table(const MotionTable& table) {
  return problems_of([&] { const TableMotion motion(table, {"rows.csv"}); });
}

TEST(TableMotion, SaysEveryProblemOfItsRowsWithTheirLines) {
  VERIFIES("LASSO-SCN-003~1");
  EXPECT_EQ(problems_of_table(MotionTable{}), "rows.csv: has no row: expected at least one");
  MotionTable table;
  table.times_s = {0, 2, 2, kNan};
  table.positions_m.assign(4, Vec3::Zero());
  table.positions_m[1].y() = kNan;
  table.velocities_mps.assign(4, Vec3::Zero());
  table.velocities_mps[0].x() = kNan;
  table.attitudes.assign(4, Quat::Identity());
  table.attitudes[2] = Quat(0.9, 0, 0, 0);
  table.omegas_radps.assign(4, Vec3(0, 2, 0));
  table.omegas_radps[3].x() = kNan;
  table.degree = 9;
  table.lines = {2, 3, 5, 9};
  EXPECT_EQ(problems_of_table(table),
            "rows.csv: degree: 9: needs 5 rows, and there are 4: lower the degree of interpolation, or add rows\n"
            "rows.csv:2:1: velocity: expected finite numbers, each from -1e9 to 1e9\n"
            "rows.csv:3:1: angular velocity: 2 rad/s: turns the node by half a turn or more since the row before: expected rows at most "
            "1.5707963267948966 s apart, and radians\n"
            "rows.csv:3:1: position: expected finite numbers, each from -1e9 to 1e9\n"
            "rows.csv:5:1: quaternion: length 0.9: expected a quaternion of unit length, the scalar last\n"
            "rows.csv:5:1: time: 2 s: is not after 2 s of the row before: sort the rows by time, each time once\n"
            "rows.csv:9:1: angular velocity: expected finite numbers, each from -1e9 to 1e9\n"
            "rows.csv:9:1: time: nan: expected a number of seconds from -1e9 to 1e9");
  table.velocities_mps.pop_back();
  EXPECT_EQ(problems_of_table(table), "rows.csv: has columns of different lengths");
  MotionTable good;
  good.times_s = {0, 1};
  for (const int degree : {0, 16}) {
    good.degree = degree;
    EXPECT_EQ(problems_of_table(good), "rows.csv: degree: " + std::to_string(degree) + ": expected a degree of interpolation from 1 to 15");
  }
}

}  // namespace
}  // namespace lasso::mdat::scene
