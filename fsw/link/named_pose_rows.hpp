// The rows of the packet `named_pose`. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/named_pose_report.hpp"
#include "fsw/link/row.hpp"

namespace lasso::named_pose_rows {

using P = NamedPoseTelemetry;

// clang-format off
inline constexpr TypedRow<P> kRows[] = {
  make_row<&P::scan_id>(1, "scan_id", "1", kAny, "of the frame's scan; 0 where there is none"),
  make_row<&P::t_measurement_us>(2, "t_measurement_us", "us", kAny, "time at which the registration is stated, as in pose"),
  make_row<&P::pair>(3, "pair", "1", kAtLeastZero, "which of the [relative.NAME] of the mission that have no axes of their own: 1 is the first by name; OF and IN are its frames"),
  make_row<&P::pairs>(4, "pairs", "1", kAtLeastZero, "how many there are; each has a packet"),
  make_row<&P::valid>(5, "valid", kYesNo, "the registration can be trusted"),
  make_row<&P::q_in_of>(6, "q_in_of", "1", kUnitVector, "registration: Hamilton quaternion x, y, z, w, takes axes of the frame OF to axes of the frame IN"),
  make_row<&P::p_in_of_m>(7, "p_in_of_m", "m", kAny, "registration: origin of the frame OF in the frame IN"),
  make_row<&P::covariance>(8, "covariance", "rad,m", kAny, "of the registration, upper triangle by rows: rotation about the origin of the frame OF, translation; axes of the frame IN"),
  make_row<&P::started>(9, "started", kYesNo, "the filter has a pose; if not, the rest says nothing"),
  make_row<&P::t_filter_us>(10, "t_filter_us", "us", kAny, "time at which the filter's pose and rates are stated"),
  make_row<&P::filter_q_in_of>(11, "filter_q_in_of", "1", kUnitVector, "filtered attitude, as q_in_of"),
  make_row<&P::filter_p_in_of_m>(12, "filter_p_in_of_m", "m", kAny, "filtered position, as p_in_of_m"),
  make_row<&P::filter_omega_radps>(13, "filter_omega_radps", "rad/s", kAny, "filtered angular rate, axes of the frame IN"),
  make_row<&P::filter_v_mps>(14, "filter_v_mps", "m/s", kAny, "filtered velocity of the origin of the frame OF, axes of the frame IN"),
  make_row<&P::filter_covariance>(15, "filter_covariance", "rad,m,rad/s,m/s", kAny, "of these, upper triangle by rows: rotation, translation, angular rate, velocity; axes of the frame IN"),
};
// clang-format on

}  // namespace lasso::named_pose_rows
