// Flight images with further sensors.
#pragma once

#include "ut/support/box_parts.hpp"

namespace lasso::test {

// The mission's own sensor, and where it is used.
inline SensorParameters sensor_of(const MissionParameters& p, double use_from_m, double use_to_m) {
  SensorParameters sensor = p;
  sensor.use_from_m = use_from_m;
  sensor.use_to_m = use_to_m;
  return sensor;
}

constexpr std::size_t kSensorsTable = 17;  // in BoxTables

inline void append_sensor(const SensorParameters& sensor, Words& words) {
  for (const ParameterRow& row : sensor_rows()) append_value(sensor.*sensor_member(row), words);
}

}  // namespace lasso::test
