#include "mdat/scene/interpolation.hpp"

#include <array>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat::scene {
namespace {

// Below this angle, in rad, series replace quotients of small numbers: what they leave out is below 1e-18.
constexpr double kSmall = 1e-2;

// At the end of a table: the derivative of the parabola through the last point and the two beside it.
Vec3 end_slope(const Vec3& near_secant, const Vec3& far_secant, double near_span_s, double far_span_s) {
  return near_secant + (near_secant - far_secant) * (near_span_s / (near_span_s + far_span_s));
}

}  // namespace

Sample interpolate(std::span<const double> times_s, std::span<const Vec3> values, std::span<const Vec3> derivatives, double t_s) {
  const std::size_t multiplicity = derivatives.empty() ? 1 : 2;
  const std::size_t count = multiplicity * times_s.size();
  std::array<double, kMostNodes> node_s{};
  std::array<Vec3, kMostNodes> difference;
  for (std::size_t i = 0; i < count; ++i) {
    node_s[i] = times_s[i / multiplicity];
    difference[i] = values[i / multiplicity];
  }
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t i = count - 1; i >= order; --i) {
      const bool repeated = multiplicity == 2 && order == 1 && i % 2 == 1;
      difference[i] = repeated ? derivatives[i / 2] : Vec3((difference[i] - difference[i - 1]) / (node_s[i] - node_s[i - order]));
    }
  }
  Sample sample{difference[count - 1], Vec3::Zero()};
  for (std::size_t i = count - 1; i-- > 0;) {  // Horner, with the derivative
    sample.derivative = sample.derivative * (t_s - node_s[i]) + sample.value;
    sample.value = sample.value * (t_s - node_s[i]) + difference[i];
  }
  return sample;
}

std::vector<Vec3> slopes(const std::vector<double>& times_s, const std::vector<Vec3>& secants) {
  if (secants.size() == 1) return {secants[0], secants[0]};
  const auto span_s = [&](std::size_t i) { return times_s[i + 1] - times_s[i]; };
  const std::size_t last = secants.size() - 1;
  std::vector<Vec3> result{end_slope(secants[0], secants[1], span_s(0), span_s(1))};
  for (std::size_t i = 1; i <= last; ++i) {
    result.emplace_back((span_s(i) * secants[i - 1] + span_s(i - 1) * secants[i]) / (span_s(i - 1) + span_s(i)));
  }
  result.push_back(end_slope(secants[last], secants[last - 1], span_s(last), span_s(last - 1)));
  return result;
}

Mat3 right_jacobian(const Vec3& rotation_rad) {
  const double angle2 = rotation_rad.squaredNorm();
  const Mat3 cross = skew(rotation_rad);
  if (angle2 < kSmall * kSmall) {
    const double first = 0.5 - angle2 * (1.0 / 24 - angle2 * (1.0 / 720 - angle2 / 40320));
    const double second = 1.0 / 6 - angle2 * (1.0 / 120 - angle2 * (1.0 / 5040 - angle2 / 362880));
    return Mat3::Identity() - first * cross + second * cross * cross;
  }
  const double angle = square_root(angle2);
  const SinCos half = sin_cos(0.5 * angle), whole = sin_cos(angle);
  return Mat3::Identity() - 2 * half.sin * half.sin / angle2 * cross + (angle - whole.sin) / (angle2 * angle) * cross * cross;
}

Mat3 inverse_right_jacobian(const Vec3& rotation_rad) {
  const double angle2 = rotation_rad.squaredNorm();
  const Mat3 cross = skew(rotation_rad);
  double factor = 1.0 / 12 + angle2 * (1.0 / 720 + angle2 * (1.0 / 30240 + angle2 / 1209600));
  if (angle2 >= kSmall * kSmall) {
    const double half = 0.5 * square_root(angle2);
    const SinCos of_half = sin_cos(half);
    factor = (1 - half * of_half.cos / of_half.sin) / angle2;
  }
  return Mat3::Identity() + 0.5 * cross + factor * cross * cross;
}

Turning interpolate(const Turning& begin, const Turning& end, double span_s, double t_s) {
  const Vec3 whole_rad = log_so3(begin.q_a_b.conjugate() * end.q_a_b);
  const std::array<double, 2> times_s{0, span_s};
  const std::array<Vec3, 2> values{Vec3::Zero(), whole_rad};
  const std::array<Vec3, 2> derivatives{begin.omega_b_radps, inverse_right_jacobian(whole_rad) * end.omega_b_radps};
  const Sample rotation = interpolate(times_s, values, derivatives, t_s);
  return {normalized(begin.q_a_b * exp_so3(rotation.value)), right_jacobian(rotation.value) * rotation.derivative};
}

}  // namespace lasso::mdat::scene
