// Elementary functions with the same bits on every target: additions, multiplications, divisions and integer operations only.
// Domain errors give NaN, as in the C library. Errors are bounds over the stated domain, shown by tests against the host's libm.
#pragma once

namespace lasso {

struct SinCos {
  double sin;
  double cos;
};

double square_root(double x);          // correctly rounded; x < 0 gives NaN
SinCos sin_cos(double angle_rad);      // |angle| <= 1e6 rad: absolute error <= 1e-15 (relative reduction in two parts)
double arc_tangent2(double y, double x);  // (-pi, pi], error <= 2e-15 rad; (0, 0) gives 0
double arc_sine(double x);             // |x| <= 1, error <= 2e-15 rad
double exponential(double x);          // relative error <= 1e-14; under- and overflow saturate to 0 and infinity
double normal_density(double z);       // exp(-z^2/2)/sqrt(2 pi)
double normal_cumulative(double z);    // Phi(z), absolute error <= 1e-14, relative error <= 1e-10 down to z = -30
bool is_finite(double x);

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;

}  // namespace lasso
