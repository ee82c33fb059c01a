// Between the rows of a table: polynomials for positions, cubics of the rotation vector for attitudes; each with its exact derivative.
#pragma once

#include <span>
#include <vector>

#include "fsw/geometry/so3.hpp"

namespace lasso::mdat::scene {

struct Sample {
  Vec3 value = Vec3::Zero();
  Vec3 derivative = Vec3::Zero();  // 1/s
};

constexpr std::size_t kMostNodes = 16;  // of one polynomial: its degree is one less

// The polynomial through `values` at `times_s` (ascending), and through `derivatives` there if they are given (Hermite), at t_s.
// Newton's divided differences; with derivatives each time is a node twice. At least one and at most kMostNodes nodes.
Sample interpolate(std::span<const double> times_s, std::span<const Vec3> values, std::span<const Vec3> derivatives, double t_s);

// The derivatives of a function at `times_s` (two or more), from its secants between them: those of the parabola through each point and
// its two neighbours, at the ends that of the nearest parabola; of two points the secant. Exact for parabolas.
std::vector<Vec3> slopes(const std::vector<double>& times_s, const std::vector<Vec3>& secants);

// Derivative of the exponential: exp(v + dv) = exp(v) exp(J dv) to first order, with |v| < 2 pi for the inverse.
Mat3 right_jacobian(const Vec3& rotation_rad);
Mat3 inverse_right_jacobian(const Vec3& rotation_rad);

// A frame b that turns in a frame a: its attitude q_a_b, and its angular velocity in its own axes.
struct Turning {
  Quat q_a_b = Quat(1, 0, 0, 0);
  Vec3 omega_b_radps = Vec3::Zero();
};

// From `begin` to `end`, span_s later, at t_s after the begin: begin.q exp(v(t)), v the cubic with v(0) = 0, exp(v(span_s)) = end.q by
// the shorter way, and the angular velocities at both ends. The angular velocity is the exact derivative of the attitude.
Turning interpolate(const Turning& begin, const Turning& end, double span_s, double t_s);

}  // namespace lasso::mdat::scene
