// The rows of the packet `filter`. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/filter_report.hpp"
#include "fsw/link/row.hpp"

namespace lasso::filter_rows {

using F = FilterTelemetry;

// clang-format off
inline constexpr TypedRow<F> kRows[] = {
  make_row<&F::scan_id>(1, "scan_id", "1", kAny, "of the frame's scan; 0 where there is none"),
  make_row<&F::t_us>(2, "t_us", "us", kAny, "time at which the filter's pose and rates are stated"),
  make_row<&F::started>(3, "started", kYesNo, "the filter has a pose; if not, the rest says nothing"),
  make_row<&F::accepted>(4, "accepted", "1", kAny, "registrations that it has joined since its start"),
  make_row<&F::rejected>(5, "rejected", "1", kAny, "registrations that its gate kept out"),
  make_row<&F::covariance>(6, "covariance", "rad,m,rad/s,m/s", kAny, "of the filtered pose, upper triangle by rows: rotation about target origin, translation, angular rate, velocity; sensor axes"),
  make_row<&F::common>(7, "common", "rad,m", kAny, "by rows of rotation and translation: what 1 sigma of the errors that a scan's rays have in common does to the registration's pose: range, turns about x, y, z. "
    "A filter of your own takes the pose and covariance of the packet pose, never filtered ones; these columns are what its scans share (sensor.common_memory_s)"),
};
// clang-format on

}  // namespace lasso::filter_rows
