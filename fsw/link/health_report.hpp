// The component's health, as its table of faults has it (fsw/exec/faults.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/link/housekeeping.hpp"
#include "fsw/link/packet.hpp"

namespace lasso {

struct HealthTelemetry {
  std::uint32_t active_faults = 0;  // a bit each: 1 << number of the fault
  std::uint32_t past_faults = 0;    // confirmed since the start
  std::uint32_t confirmations = 0;
  std::uint8_t reset_cause = 0;    // ResetCause
  std::uint8_t failed_tests = 0;   // a bit each: 1 << number of the self-test
  std::uint32_t unfed_frames = 0;  // boundaries at which the watchdog was not fed
  std::uint32_t mode_repairs = 0;  // disagreeing copies of the mode
  std::uint32_t clock_jumps = 0;
  std::int64_t worst_lateness_us = 0;  // of a slot
};

constexpr std::size_t kMaxHealthBytes = 64;

// A whole packet; `header` says counts and time. The size, 0 when `out` is too small.
std::size_t encode_health(const HealthTelemetry& health, const PacketHeader& header, Bytes out);

}  // namespace lasso
