#include "mdat/scene/elliptic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

// The integral of 1 / ((1 - n sin^2 a) sqrt(1 - m sin^2 a)) by Simpson's rule in 200,000 steps.
double by_quadrature(double n, double amplitude_rad, double m1) {
  const auto integrand = [&](double a) {
    const double s2 = std::sin(a) * std::sin(a);
    return 1 / ((1 - n * s2) * std::sqrt(1 - (1 - m1) * s2));
  };
  const int steps = 200000;
  const double h = amplitude_rad / steps;
  double sum = integrand(0) + integrand(amplitude_rad);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * integrand(h * i);
  return sum * h / 3;
}

Amplitude of_angle(double angle_rad) {
  const double half_turns = std::round(angle_rad / M_PI);
  return {half_turns, {std::sin(angle_rad - half_turns * M_PI), std::cos(angle_rad - half_turns * M_PI)}};
}

TEST(Elliptic, TheIntegralsAreThoseOfQuadrature) {
  VERIFIES("LASSO-SCN-007~1");
  test::Generator random(41);
  for (const double m1 : {1.0, 0.9, 0.3, 0.01}) {
    const double angle_rad = random.uniform(-8, 8), n = -random.uniform(0, 30);
    EXPECT_NEAR(elliptic_first(of_angle(angle_rad), m1), by_quadrature(0, angle_rad, m1), 1e-11) << m1;
    EXPECT_NEAR(elliptic_third(n, of_angle(angle_rad), m1), by_quadrature(n, angle_rad, m1), 1e-11) << m1;
  }
}

// 1 - 1e-20 is 1 in doubles: K(m) = ln(4 / sqrt(m1)), and am(u) the Gudermannian, to the first order of m1.
TEST(Elliptic, NothingIsLostNearOne) {
  VERIFIES("LASSO-SCN-007~1");
  for (const double m1 : {1e-12, 1e-20, 1e-30}) {
    const double quarter = std::log(4 / std::sqrt(m1));
    EXPECT_NEAR(elliptic_first({0, {1, 0}}, m1), quarter, 1e-10);
    for (const double u : {-1.3, 0.2, 5.0, 10.0}) {
      const SinCos found = whole_angle(jacobi_amplitude(u, m1));
      EXPECT_NEAR(found.sin, std::tanh(u), 1e-11);
      EXPECT_NEAR(found.cos * std::cosh(u), 1, u < 6 ? 1e-7 : 1e-3) << m1;  // relative: it is as small as 1e-4
      EXPECT_NEAR(elliptic_first(jacobi_amplitude(u, m1), m1), u, 1e-10);
    }
    EXPECT_NEAR(whole_angle(jacobi_amplitude(quarter, m1)).cos / std::sqrt(m1), 0, 1e-9);
  }
}

TEST(Elliptic, TheAmplitudeInvertsTheFirstKind) {
  VERIFIES("LASSO-SCN-007~1");
  test::Generator random(42);
  for (const double m1 : {1.0, 0.999, 0.4, 1e-3, 1e-9}) {
    for (int trial = 0; trial < 20; ++trial) {
      const double angle_rad = random.uniform(-20, 20);
      const SinCos found = whole_angle(jacobi_amplitude(elliptic_first(of_angle(angle_rad), m1), m1));
      ASSERT_NEAR(found.sin, std::sin(angle_rad), 1e-12) << m1;
      ASSERT_NEAR(found.cos, std::cos(angle_rad), 1e-12) << m1;
    }
  }
}

TEST(Elliptic, AnglesAreHalfTurnsAndARest) {
  VERIFIES("LASSO-SCN-007~1");
  for (const double angle_rad : {-3.0, -1.5, 0.0, 0.7, 1.6, 3.1}) {
    const Amplitude amplitude = to_amplitude(std::sin(angle_rad), std::cos(angle_rad));
    EXPECT_GE(amplitude.rest.cos, 0);
    EXPECT_EQ(whole_angle(amplitude).sin, std::sin(angle_rad));
    EXPECT_EQ(whole_angle(amplitude).cos, std::cos(angle_rad));
  }
}

}  // namespace
}  // namespace lasso::mdat::scene
