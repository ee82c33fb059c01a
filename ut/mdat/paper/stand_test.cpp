#include "mdat/paper/stand.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Vec3 any_vector(test::Generator& random, double size) {
  const double x = random.normal(), y = random.normal();
  return size * Vec3(x, y, random.normal());
}

TEST(Stand, ATurnAboutTheAxisIsFoundFromAnyAttitudeAndWhateverElseIsOff) {
  VERIFIES("LASSO-MDT-121~1");
  test::Generator random(5);
  for (int i = 0; i < 50; ++i) {
    const Quat from = exp_so3(any_vector(random, 1));
    const double turn_rad = random.uniform(-3, 3);
    EXPECT_NEAR(turn_about_x(from, from * exp_so3(turn_rad * Vec3::UnitX())), turn_rad, 1e-12);
    // The swing is about an axis across x: it is no part of the twist.
    const double swing_rad = random.uniform(-0.5, 0.5);
    const Vec3 across = Vec3(0, random.uniform(-1, 1), 1).normalized();
    EXPECT_NEAR(turn_about_x(from, from * exp_so3(swing_rad * across) * exp_so3(turn_rad * Vec3::UnitX())), turn_rad, 1e-12);
  }
}

TEST(Stand, AnErrorOfTheTurnKnowsNoFullTurnsAndNoSignOfQuaternions) {
  VERIFIES("LASSO-MDT-121~1");
  const Quat from = exp_so3(Vec3(0.4, -0.7, 2.1));
  const double step_rad = 15 * kRadPerDeg, error_rad = -0.008;
  const Quat to = from * exp_so3((step_rad + error_rad) * Vec3::UnitX());
  EXPECT_NEAR(turn_error(from, to, step_rad), error_rad, 1e-12);
  EXPECT_NEAR(turn_error(from, to, step_rad - 2 * kPi), error_rad, 1e-12);
  EXPECT_NEAR(turn_error(from, Quat(-to.w(), -to.x(), -to.y(), -to.z()), step_rad), error_rad, 1e-12);
}

TEST(Stand, TheMeanOfEstimatesIsWhatTheyAreDrawnAbout) {
  VERIFIES("LASSO-MDT-121~1");
  test::Generator random(6);
  const Pose truth{exp_so3(Vec3(-0.9, 0.3, 1.4)), Vec3(0.1, -0.2, 4)};
  std::vector<Pose> estimates;
  for (int i = 0; i < 100; ++i) {  // in pairs about the truth: its mean is known without chance
    const Vec3 turn = any_vector(random, 0.02), shift = any_vector(random, 0.003);
    for (const double sign : {1.0, -1.0}) estimates.push_back({truth.q * exp_so3(sign * turn), truth.p + sign * shift});
  }
  const StandMean mean = mean_of_stand(estimates);
  EXPECT_LT(log_so3(truth.q.conjugate() * mean.pose.q).norm(), 1e-9);
  EXPECT_LT((mean.pose.p - truth.p).norm(), 1e-12);
}

TEST(Stand, TheSpreadOfAStandIsThatOfTheWholePopulation) {
  VERIFIES("LASSO-MDT-121~1");
  const Quat q = exp_so3(Vec3(0.2, 0.5, -0.3));
  std::vector<Pose> estimates;
  for (const double step : {-1.0, 0.0, 1.0})
    estimates.push_back({q * exp_so3(0.006 * step * Vec3::UnitX()), Vec3(step, -step, 3 + 0.003 * step)});
  const StandMean mean = mean_of_stand(estimates);
  EXPECT_NEAR(mean.z_std_m, 0.003 * std::sqrt(2.0 / 3), 1e-12);
  EXPECT_NEAR(mean.turn_std_rad, 0.006 * std::sqrt(2.0 / 3), 1e-9);
}

}  // namespace
}  // namespace lasso::mdat
