#include "mdat/scene/interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

// A random polynomial, and its derivative, by powers.
struct Polynomial {
  std::vector<Vec3> coefficients;

  Sample at(double t) const {
    Sample sample;
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      sample.value += coefficients[i] * std::pow(t, static_cast<double>(i));
      if (i > 0) sample.derivative += coefficients[i] * (static_cast<double>(i) * std::pow(t, static_cast<double>(i) - 1));
    }
    return sample;
  }
};

Polynomial random_polynomial(test::Generator& random, std::size_t degree) {
  Polynomial polynomial;
  for (std::size_t i = 0; i <= degree; ++i) polynomial.coefficients.push_back(random_vector(random, 1));
  return polynomial;
}

TEST(Interpolate, GivesBackAPolynomialOfItsDegreeAndItsDerivative) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(21);
  for (std::size_t rows = 1; rows <= 8; ++rows) {
    for (const bool hermite : {true, false}) {
      const Polynomial polynomial = random_polynomial(random, (hermite ? 2 * rows : rows) - 1);
      std::vector<double> times;
      std::vector<Vec3> values, derivatives;
      for (std::size_t i = 0; i < rows; ++i) {
        times.push_back(-1 + 2 * (static_cast<double>(i) + random.uniform(0, 0.5)) / static_cast<double>(rows));
        values.push_back(polynomial.at(times.back()).value);
        if (hermite) derivatives.push_back(polynomial.at(times.back()).derivative);
      }
      for (const double t : {-0.9, 0.1, 0.8, times[0]}) {
        const Sample found = interpolate(times, values, derivatives, t), expected = polynomial.at(t);
        ASSERT_NEAR((found.value - expected.value).norm(), 0, 1e-9) << rows;
        ASSERT_NEAR((found.derivative - expected.derivative).norm(), 0, 1e-8) << rows;
      }
    }
  }
}

TEST(Slopes, AreThoseOfAParabolaAndOfAStraightLine) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(22);
  for (const std::size_t degree : {1U, 2U}) {
    const Polynomial polynomial = random_polynomial(random, degree);
    const std::vector<double> times = degree == 1 ? std::vector<double>{0.2, 1.7} : std::vector<double>{-2, -1.5, 0.25, 4};
    std::vector<Vec3> secants;
    for (std::size_t i = 1; i < times.size(); ++i) {
      secants.emplace_back((polynomial.at(times[i]).value - polynomial.at(times[i - 1]).value) / (times[i] - times[i - 1]));
    }
    const std::vector<Vec3> found = slopes(times, secants);
    ASSERT_EQ(found.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR((found[i] - polynomial.at(times[i]).derivative).norm(), 0, 1e-13) << i;
  }
}

TEST(RightJacobian, IsTheDerivativeOfTheExponential) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(23);
  for (const double angle : {0.0, 1e-9, 0.0099, 0.0101, 0.7, 3.1, 3.1415926, 5.9}) {
    const Vec3 v = angle * random_vector(random, 1).normalized();
    const Mat3 found = right_jacobian(v);
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = 1e-4 * Vec3::Unit(i);
      const Vec3 ahead = log_so3(exp_so3(v).conjugate() * exp_so3(v + step));
      const Vec3 back = log_so3(exp_so3(v).conjugate() * exp_so3(v - step));
      ASSERT_NEAR(((ahead - back) / 2e-4 - found.col(i)).norm(), 0, 1e-8) << angle;
    }
    ASSERT_NEAR((found * inverse_right_jacobian(v) - Mat3::Identity()).norm(), 0, 1e-12) << angle;
  }
}

TEST(InterpolateAttitude, MeetsBothEndsWithTheirRatesAndTurnsByItsOwnRateBetween) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(24);
  for (int trial = 0; trial < 30; ++trial) {
    const Turning begin{random_attitude(random), random_vector(random, 0.5)};
    Turning end{random_attitude(random), random_vector(random, 0.5)};
    if (trial % 2 == 1) end.q_a_b = normalized(begin.q_a_b * exp_so3(random_vector(random, 1e-3)));  // almost no turn
    const double span_s = random.uniform(0.5, 4);
    const Turning first = interpolate(begin, end, span_s, 0), last = interpolate(begin, end, span_s, span_s);
    ASSERT_NEAR(first.q_a_b.angularDistance(begin.q_a_b), 0, 1e-7);
    ASSERT_NEAR(last.q_a_b.toRotationMatrix().cwiseProduct(end.q_a_b.toRotationMatrix()).sum(), 3, 1e-12);
    ASSERT_NEAR((first.omega_b_radps - begin.omega_b_radps).norm(), 0, 1e-12);
    ASSERT_NEAR((last.omega_b_radps - end.omega_b_radps).norm(), 0, 1e-10);
    const double t_s = random.uniform(0, span_s);
    const Turning now = interpolate(begin, end, span_s, t_s);
    const auto pose_at = [&](TimeUs t_us) { return Pose{interpolate(begin, end, span_s, t_s + to_seconds(t_us)).q_a_b, Vec3::Zero()}; };
    ASSERT_NEAR((difference_rates(pose_at, 0).omega_radps - rotate(now.q_a_b, now.omega_b_radps)).norm(), 0, 1e-9);
  }
}

TEST(InterpolateAttitude, IsExactForAConstantRate) {
  VERIFIES("LASSO-SCN-005~1");
  test::Generator random(25);
  for (int trial = 0; trial < 20; ++trial) {
    const Quat q = random_attitude(random);
    const Vec3 omega_b = random_vector(random, 0.4);
    const auto at = [&](double t_s) { return Turning{normalized(q * exp_so3(omega_b * t_s)), omega_b}; };
    Turning end = at(2);
    end.q_a_b.coeffs() *= -1;  // the same attitude
    const Turning now = interpolate(at(0), end, 2, 1.3);
    ASSERT_NEAR((now.q_a_b.toRotationMatrix() - at(1.3).q_a_b.toRotationMatrix()).norm(), 0, 1e-13);
    ASSERT_NEAR((now.omega_b_radps - omega_b).norm(), 0, 1e-13);
  }
}

}  // namespace
}  // namespace lasso::mdat::scene
