// Where the measuring head of an image is: one of line_head.cpp and own_head.cpp is linked to it (image.cmake).
#pragma once

#include <cstdint>

#include "fsw/sense/sensor.hpp"
#include "hal_lcs/driver.hpp"
#include "hal_lcs/head_driver.hpp"

namespace lasso::bare {

// Of an image with its head beside it alone (own_head.cpp).
extern lcs::HeadMemory head_memory;

// Serial ports (board.hpp) of the camera's line, and of the one that has commands and telemetry.
extern const std::uint32_t camera_port, ground_port;

// Of either driver. What lies where in memory is the same in all images with line_head.cpp (ft/pil/seu.py flips bits in these); in that of
// own_head.cpp the head's memory comes before.
struct alignas(lcs::Driver) alignas(lcs::HeadDriver) DriverMemory {
  std::uint8_t bytes[sizeof(lcs::Driver) > sizeof(lcs::HeadDriver) ? sizeof(lcs::Driver) : sizeof(lcs::HeadDriver)];
};

// The sensor, made anew in `memory` at each start; that of a camera at a line is at this one. Both outlive it.
Sensor& make_sensor(DriverMemory& memory, lcs::Line& camera_line);

// As the head was made, whose serial number is 1; the mission's image may have a calibration of it.
inline lcs::Calibration design_calibration() {
  lcs::Calibration design;
  design.serial = 1;
  return design;
}

}  // namespace lasso::bare
