// The rows of the packet `filter`. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/filter_report.hpp"
#include "fsw/link/row.hpp"

namespace lasso::filter_rows {

using F = FilterTelemetry;

// clang-format off
inline constexpr TypedRow<F> kRows[] = {
  make_row<&F::scan_id>(1, "scan_id", "1", kAny, "of the last scan"),
  make_row<&F::t_us>(2, "t_us", "us", kAny, "time at which the filter's pose and rates are stated"),
  make_row<&F::started>(3, "started", kYesNo, "the filter has a pose; if not, the rest says nothing"),
  make_row<&F::accepted>(4, "accepted", "1", kAny, "registrations that it has joined since its start"),
  make_row<&F::rejected>(5, "rejected", "1", kAny, "registrations that its gate kept out"),
  make_row<&F::covariance>(6, "covariance", "rad,m,rad/s,m/s", kAny, "upper triangle by rows: rotation about target origin, translation, angular rate, velocity; sensor axes. "
    "Filtered poses depend on each other: a filter of your own takes q_sensor_target, p_sensor_target_m and covariance of the packet pose, "
    "which are independent from scan to scan but for sensor.common_*"),
};
// clang-format on

}  // namespace lasso::filter_rows
