// The rows of the packet `health`. For the ground: see row.hpp.
#pragma once

#include "fsw/link/fault_choices.hpp"
#include "fsw/link/health_report.hpp"
#include "fsw/link/row.hpp"

namespace lasso::health_rows {

using H = HealthTelemetry;

// clang-format off
inline constexpr TypedRow<H> kRows[] = {
  make_row<&H::active_faults>(1, "active_faults", "1", kAny, "faults that are confirmed and not cleared, a bit each: the fault's number"),
  make_row<&H::past_faults>(2, "past_faults", "1", kAny, "faults that were confirmed since the start, likewise"),
  make_row<&H::confirmations>(3, "confirmations", "1", kAny, "of all faults since the start"),
  make_row<&H::reset_cause>(4, "reset_cause", kResetCause, "why the component started"),
  make_row<&H::failed_tests>(5, "failed_tests", "1", kAny, "self-tests at the start that failed, a bit each: rounding, subnormals, elementary functions, CRC-16, CRC-32C, codec"),
  make_row<&H::unfed_frames>(6, "unfed_frames", "1", kAny, "boundaries at which the watchdog was not fed"),
  make_row<&H::mode_repairs>(7, "mode_repairs", "1", kAny, "times that copies of the mode disagreed"),
  make_row<&H::clock_jumps>(8, "clock_jumps", "1", kAny, "times that the clock was followed over a jump"),
  make_row<&H::worst_lateness_us>(9, "worst_lateness_us", "us", kAny, "of a slot, since the start"),
};
// clang-format on

}  // namespace lasso::health_rows
