// What telemetry says of a sensor: the acquisition's tally of its scans, and its own counters.
#pragma once

#include "fsw/exec/acquisition_task.hpp"
#include "fsw/link/sensor_telemetry.hpp"

namespace lasso {

SensorTelemetry make_sensor_report(SensorNumber sensor, const ScanTally& tally, const SensorCounters& counters);

// Differs whenever something has gone wrong since: the sum, modulo 2^32, of all that is counted but scans and right frames.
std::uint32_t troubles(const SensorTelemetry& report);

}  // namespace lasso
