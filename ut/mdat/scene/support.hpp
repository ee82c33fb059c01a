// The rates of a motion by differences of its poses, random states for tests, and what a refusal says.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "mdat/scene/motion.hpp"
#include "ut/support/generator.hpp"

namespace lasso::mdat::scene {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using PoseAt = std::function<Pose(TimeUs)>;

// Central difference over 2 h; the rotation's is exact for a constant angular velocity.
inline Twist central_difference(const PoseAt& pose_at, TimeUs t_us, DurationUs h_us) {
  const Vec6 step = pose_difference(pose_at(t_us + h_us), pose_at(t_us - h_us)) / to_seconds(2 * h_us);
  return {step.head<3>(), step.tail<3>()};
}

// Extrapolated from two step widths (Richardson): the error goes with the fourth power of h.
inline Twist difference_rates(const PoseAt& pose_at, TimeUs t_us, DurationUs h_us = 1000) {
  const Twist narrow = central_difference(pose_at, t_us, h_us);
  const Twist wide = central_difference(pose_at, t_us, 2 * h_us);
  return {(4 * narrow.omega_radps - wide.omega_radps) / 3, (4 * narrow.v_mps - wide.v_mps) / 3};
}

inline double rate_error(const Twist& a, const Twist& b) {
  return std::max((a.omega_radps - b.omega_radps).norm(), (a.v_mps - b.v_mps).norm());
}

// How far the stated rates are from the differences of the poses.
inline double rate_error(const Motion& motion, TimeUs t_us, DurationUs h_us = 1000) {
  return rate_error(motion.at(t_us).rates, difference_rates([&](TimeUs t) { return motion.at(t).T_a_b; }, t_us, h_us));
}

inline Vec3 random_vector(test::Generator& random, double sigma) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return sigma * Vec3(x, y, z);
}

// Any attitude alike.
inline Quat random_attitude(test::Generator& random) {
  const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  return Quat(w, x, y, z).normalized();
}

inline Pose random_pose(test::Generator& random, double sigma_m) {
  const Quat q = random_attitude(random);
  return {q, random_vector(random, sigma_m)};
}

inline Twist random_rates(test::Generator& random, double sigma_radps, double sigma_mps) {
  const Vec3 omega_radps = random_vector(random, sigma_radps);
  return {omega_radps, random_vector(random, sigma_mps)};
}

inline TimeUs random_time_us(test::Generator& random, double from_s, double until_s) {
  return static_cast<TimeUs>(std::llround(1e6 * random.uniform(from_s, until_s)));
}

// The lines of a MissionError, or "".
inline std::string problems_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const MissionError& error) {
    return error.what();
  }
  return "";
}

}  // namespace lasso::mdat::scene
