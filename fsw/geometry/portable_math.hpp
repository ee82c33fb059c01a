// Elementary functions with the same bits on every target: additions, multiplications, divisions and integer operations only.
// Domain errors give NaN, as in the C library. Errors are bounds over the stated domain, shown by tests against the host's libm.
#pragma once

#include <limits>

namespace lasso {

struct SinCos {
  double sin;
  double cos;
};

double square_root(double x);             // correctly rounded; x < 0 gives NaN
SinCos sin_cos(double angle_rad);         // |angle| <= 1e6 rad: absolute error <= 1e-15 (Cody-Waite reduction); NaN beyond
double tangent(double angle_rad);         // |angle| < 1.5 rad: relative error <= 2e-14; NaN where sin_cos gives NaN
double arc_tangent2(double y, double x);  // (-pi, pi], error <= 2e-15 rad; (0, 0) gives 0; the sign of a zero has no meaning
double arc_sine(double x);                // |x| <= 1, error <= 2e-15 rad
double exponential(double x);             // relative error <= 1e-14; saturates to infinity, and to 0 instead of a subnormal result
double normal_density(double z);          // exp(-z^2/2)/sqrt(2 pi), relative error <= 1e-14 (1 + z^2/20) down to 1e-307
double normal_cumulative(double z);       // Phi(z), absolute error <= 1e-14, relative error <= 1e-10 down to z = -30
double clamp(double x, double low, double high);
double fractional_part(double x);  // exact, of the sign of x; |x| < 2^63
inline bool is_finite(double x) { return __builtin_fabs(x) < std::numeric_limits<double>::infinity(); }

namespace detail {
// What square_root uses where no instruction does it (603e). Public for the test that compares it with one bit for bit.
double square_root_in_software(double x);
}  // namespace detail

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;

}  // namespace lasso
