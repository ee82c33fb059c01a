#include "fsw/geometry/so3.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

// Below these squares the series to three terms are exact to 1e-18.
constexpr double kSmallRotation2 = 1e-4;
constexpr double kSmallTangent2 = 1e-6;

double largest_magnitude(const Quat& q) {
  double largest = 0;
  for (int i = 0; i < 4; ++i) {
    const double c = q.coeffs()[i] < 0 ? -q.coeffs()[i] : q.coeffs()[i];
    if (c > largest) largest = c;
  }
  return largest;
}

// Shepperd: from 4 c_i^2 = 1 + (three signed diagonal terms) of the largest component c_i; the others are quotients by it.
Quat from_largest_vector_component(const Mat3& R, int i) {
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  const double root = square_root(1.0 + R(i, i) - R(j, j) - R(k, k));
  const double scale = 0.5 / root;
  Quat q;
  q.coeffs()[i] = 0.5 * root;
  q.coeffs()[j] = (R(j, i) + R(i, j)) * scale;
  q.coeffs()[k] = (R(k, i) + R(i, k)) * scale;
  q.w() = (R(k, j) - R(j, k)) * scale;
  return q;
}

Quat from_scalar_component(const Mat3& R, double trace) {
  const double root = square_root(1.0 + trace);
  const double scale = 0.5 / root;
  return Quat(0.5 * root, (R(2, 1) - R(1, 2)) * scale, (R(0, 2) - R(2, 0)) * scale, (R(1, 0) - R(0, 1)) * scale);
}

}  // namespace

Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Quat exp_so3(const Vec3& rotation_rad) {
  const double angle2 = rotation_rad.squaredNorm();
  if (angle2 < kSmallRotation2) {
    const double factor = 0.5 - angle2 * (1.0 / 48.0 - angle2 * (1.0 / 3840.0));  // sin(a/2)/a
    const double w = 1.0 - angle2 * (0.125 - angle2 * (1.0 / 384.0 - angle2 * (1.0 / 46080.0)));
    return Quat(w, factor * rotation_rad.x(), factor * rotation_rad.y(), factor * rotation_rad.z());
  }
  const double angle = square_root(angle2);
  const SinCos half = sin_cos(0.5 * angle);
  const double factor = half.sin / angle;
  return Quat(half.cos, factor * rotation_rad.x(), factor * rotation_rad.y(), factor * rotation_rad.z());
}

Vec3 log_so3(const Quat& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;  // of the two names of the rotation, the one with the shorter way
  const double w = sign * q.w();
  const Vec3 v = sign * q.vec();
  const double sine2 = v.squaredNorm();
  if (sine2 < kSmallTangent2 * w * w) {
    const double t2 = sine2 / (w * w);
    return (2.0 / w) * (1.0 - t2 * (1.0 / 3.0 - t2 * 0.2)) * v;  // atan(t)/t
  }
  const double sine = square_root(sine2);
  return (2.0 * arc_tangent2(sine, w) / sine) * v;
}

Quat normalized(const Quat& q) {
  const double scale = largest_magnitude(q);  // first, so that squares neither over- nor underflow
  if (scale == 0 && q.coeffs() == Quat::Coefficients::Zero()) return Quat(1, 0, 0, 0);
  const Quat s(q.w() / scale, q.x() / scale, q.y() / scale, q.z() / scale);
  const double length = square_root(s.coeffs().squaredNorm());
  return Quat(s.w() / length, s.x() / length, s.y() / length, s.z() / length);
}

Mat3 to_matrix(const Quat& q) { return q.toRotationMatrix(); }

Quat to_quaternion(const Mat3& R) {
  const double trace = R(0, 0) + R(1, 1) + R(2, 2);
  int largest = 0;
  if (R(1, 1) > R(largest, largest)) largest = 1;
  if (R(2, 2) > R(largest, largest)) largest = 2;
  const Quat q = trace > R(largest, largest) ? from_scalar_component(R, trace) : from_largest_vector_component(R, largest);
  return normalized(q);
}

Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 twice = 2.0 * q.vec().cross(v);
  return v + q.w() * twice + q.vec().cross(twice);
}

// Roll comes from the axes turned back by the yaw, so that the three angles together give R even where pitch is near +-pi/2 and yaw alone
// means little; exactly there yaw is 0.
Vec3 euler_zyx(const Mat3& R) {
  const double cos_pitch = square_root(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
  const double sin_yaw = cos_pitch > 0 ? R(1, 0) / cos_pitch : 0.0;
  const double cos_yaw = cos_pitch > 0 ? R(0, 0) / cos_pitch : 1.0;
  const double yaw = arc_tangent2(sin_yaw, cos_yaw);
  const double pitch = arc_tangent2(-R(2, 0), cos_pitch);
  const double roll = arc_tangent2(sin_yaw * R(0, 2) - cos_yaw * R(1, 2), cos_yaw * R(1, 1) - sin_yaw * R(0, 1));
  return Vec3(yaw, pitch, roll);
}

}  // namespace lasso
