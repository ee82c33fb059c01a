// Where the measuring head of an image is: one of line_head.cpp and own_head.cpp is linked to it (image.cmake).
#pragma once

#include <cstdint>

#include "fsw/sense/sensor.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::bare {

// Serial ports (board.hpp) of the camera's line, and of the one that has commands and telemetry.
extern const std::uint32_t camera_port, ground_port;

// The sensor, made anew at each start; at a line of a camera that is this one.
Sensor& make_sensor(lcs::Line& camera_line);

// As the head was made, whose serial number is 1; the mission's image may have a calibration of it.
inline lcs::Calibration design_calibration() {
  lcs::Calibration design;
  design.serial = 1;
  return design;
}

}  // namespace lasso::bare
