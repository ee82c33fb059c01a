#include "mdat/scene/elliptic.hpp"

#include <array>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cmath>

namespace lasso::mdat::scene {
namespace {

// Of an amplitude within a quarter turn, by Carlson's forms (NIST Handbook of Mathematical Functions, 19.25.5 and 19.25.14); with n = 0
// it is the first kind.
double within_quarter(double n, const SinCos& a, double m1) {
  const double delta2 = m1 + (1 - m1) * a.cos * a.cos;
  const double sin2 = a.sin * a.sin;
  const double first = a.sin * boost::math::ellint_rf(a.cos * a.cos, delta2, 1.0);
  if (n == 0) return first;
  return first + n / 3 * sin2 * a.sin * boost::math::ellint_rj(a.cos * a.cos, delta2, 1.0, 1 - n * sin2);
}

double of_any_amplitude(double n, const Amplitude& amplitude, double m1) {
  const double rest = within_quarter(n, amplitude.rest, m1);
  return amplitude.half_turns == 0 ? rest : rest + 2 * amplitude.half_turns * within_quarter(n, {1, 0}, m1);
}

// Descending Landen transformation by the arithmetic-geometric mean (NIST Handbook, 22.20(ii)). The arc sine of its step is an arc tangent
// here: 1 - (c/a)^2 = (b/a)^2 holds without cancellation.
class Landen {
 public:
  explicit Landen(double m1) : b_{square_root(m1)} {
    while (last_ + 1 < kMost && a_[last_] - b_[last_] > 1e-15 * a_[last_]) {
      a_[last_ + 1] = 0.5 * (a_[last_] + b_[last_]);
      b_[last_ + 1] = square_root(a_[last_] * b_[last_]);
      c_[last_ + 1] = 0.5 * (a_[last_] - b_[last_]);
      ++last_;
    }
  }
  double quarter_period() const { return kPi / (2 * a_[last_]); }  // K(m)
  // Of an amplitude within a quarter turn.
  SinCos sn_cn(double u) const {
    double angle = std::ldexp(a_[last_] * u, static_cast<int>(last_));
    for (std::size_t i = last_; i > 0; --i) {
      const SinCos of_angle = sin_cos(angle);
      const double cosine = square_root(b_[i] * b_[i] + c_[i] * c_[i] * of_angle.cos * of_angle.cos);
      angle = 0.5 * (angle + arc_tangent2(c_[i] * of_angle.sin, cosine));
    }
    return sin_cos(angle);
  }

 private:
  static constexpr std::size_t kMost = 40;  // the mean converges quadratically: 6 steps from m1 = 1e-16
  std::array<double, kMost> a_{1}, b_, c_{};
  std::size_t last_ = 0;
};

}  // namespace

Amplitude to_amplitude(double sine, double cosine) {
  if (cosine < 0) return {1, {-sine, -cosine}};
  return {0, {sine, cosine}};
}

SinCos whole_angle(const Amplitude& amplitude) {
  const double sign = std::remainder(amplitude.half_turns, 2) == 0 ? 1 : -1;
  return {sign * amplitude.rest.sin, sign * amplitude.rest.cos};
}

// Beyond half of a quarter period by what is left of it: sn(u) = cn/dn(K - u), cn(u) = k' sn/dn(K - u).
Amplitude jacobi_amplitude(double u, double m1) {
  const Landen landen(m1);
  const double quarter = landen.quarter_period();
  const double half_turns = std::round(u / (2 * quarter));
  const double rest = u - half_turns * 2 * quarter;
  if (std::fabs(rest) <= quarter / 2) return {half_turns, landen.sn_cn(rest)};
  const SinCos left = landen.sn_cn(std::fmax(quarter - std::fabs(rest), 0));
  const double delta = square_root(m1 + (1 - m1) * left.cos * left.cos);
  return {half_turns, {std::copysign(left.cos / delta, rest), square_root(m1) * left.sin / delta}};
}

double elliptic_first(const Amplitude& amplitude, double m1) { return of_any_amplitude(0, amplitude, m1); }

double elliptic_third(double n, const Amplitude& amplitude, double m1) { return of_any_amplitude(n, amplitude, m1); }

}  // namespace lasso::mdat::scene
