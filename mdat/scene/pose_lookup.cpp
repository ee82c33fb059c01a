#include "mdat/scene/pose_lookup.hpp"

#include <algorithm>

#include "fsw/geometry/so3.hpp"
#include "mdat/scene/interpolation.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kTolerance = 1e-9;

// Through a and b with slopes da and db, each over the whole interval.
void set_cubic(const Vec3& a, const Vec3& b, const Vec3& da, const Vec3& db, Vec3 (&c)[4]) {
  c[0] = a;
  c[1] = da;
  c[2] = 3 * (b - a) - 2 * da - db;
  c[3] = da + db - 2 * (b - a);
}

}  // namespace

Pose PoseLookup::at(TimeUs t_us) {
  const std::int64_t number = t_us >> kIntervalBits;
  if (!made_ || number != interval_) make_interval(number);
  if (!smooth_) return exact_(t_us).T_a_b;
  return on_cubics(static_cast<double>(t_us - (number << kIntervalBits)) / (1 << kIntervalBits));
}

void PoseLookup::make_interval(std::int64_t number) {
  constexpr double kSpan_s = 1e-6 * (1 << kIntervalBits);
  const TimeUs begin_us = number << kIntervalBits;
  const MotionState begin = exact_(begin_us), end = exact_(begin_us + (1 << kIntervalBits));
  q_begin_ = begin.T_a_b.q;
  set_cubic(begin.T_a_b.p, end.T_a_b.p, kSpan_s * begin.rates.v_mps, kSpan_s * end.rates.v_mps, position_.c);
  const Vec3 turn_rad = log_so3(q_begin_.conjugate() * end.T_a_b.q);
  const Vec3 begin_rate = kSpan_s * rotate(q_begin_.conjugate(), begin.rates.omega_radps);
  const Vec3 end_rate = kSpan_s * rotate(end.T_a_b.q.conjugate(), end.rates.omega_radps);
  set_cubic(Vec3::Zero(), turn_rad, begin_rate, inverse_right_jacobian(turn_rad) * end_rate, rotation_.c);
  smooth_ = true;
  for (const int quarter : {1, 2, 3}) {
    const double u = 0.25 * quarter;
    smooth_ = smooth_ && is_near(exact_(begin_us + quarter * (1 << (kIntervalBits - 2))).T_a_b, u);
  }
  interval_ = number;
  made_ = true;
}

Pose PoseLookup::on_cubics(double u) const { return {normalized(q_begin_ * exp_so3(rotation_.at(u))), position_.at(u)}; }

bool PoseLookup::is_near(const Pose& exact, double u) const {
  const Pose pose = on_cubics(u);
  const double off_rad = log_so3(exact.q.conjugate() * pose.q).norm();
  return off_rad <= kTolerance && (pose.p - exact.p).norm() <= kTolerance * std::max(1.0, exact.p.norm());
}

}  // namespace lasso::mdat::scene
