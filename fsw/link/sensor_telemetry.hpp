// How a sensor fares, as plain values: what the packet `sensor` says. The executive fills it, its rows (sensor_rows.hpp) carry it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/link/housekeeping.hpp"
#include "fsw/link/packet.hpp"

namespace lasso {

struct SensorTelemetry {
  std::uint8_t sensor = 0;
  std::uint32_t scans = 0;
  std::uint32_t lost = 0;      // the sum of the items lost_*
  std::uint8_t last_loss = 0;  // ScanLoss
  std::uint32_t lost_inhibited = 0;
  std::uint32_t lost_no_room = 0;
  std::uint32_t lost_silent = 0;
  std::uint32_t lost_busy = 0;
  std::uint32_t lost_refused = 0;
  std::uint32_t lost_restarted = 0;
  std::uint32_t lost_foreign = 0;
  std::uint32_t lost_stopped = 0;
  std::uint32_t lost_off_plan = 0;
  std::uint32_t lost_other = 0;
  std::uint32_t lost_unfinished = 0;
  std::uint32_t lost_thin = 0;
  std::uint32_t lost_stuck = 0;
  std::uint32_t lost_frozen = 0;

  std::uint32_t frames = 0;
  std::uint32_t damaged_frames = 0;
  std::uint32_t missing_frames = 0;
  std::uint32_t repeated_frames = 0;
  std::uint32_t unknown_frames = 0;
  std::uint32_t strayed = 0;
  std::uint32_t samples_lost = 0;
  std::uint32_t samples_refused = 0;
  std::uint32_t bad_times = 0;
  std::uint32_t off_plan = 0;
  std::uint32_t clock_jumps = 0;
  std::uint32_t restarts = 0;
  std::uint32_t samples_outside = 0;
  std::uint8_t calibration = 0;
};

constexpr std::size_t kMaxSensorPacketBytes = 160;

// A whole packet; `header` says counts and time. The size, 0 when `out` is too small.
std::size_t encode_sensor(const SensorTelemetry& sensor, PacketHeader header, Bytes out);

}  // namespace lasso
