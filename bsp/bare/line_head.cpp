// The head of an image for a flight card: in a camera of its own, at the end of a line.
#include <new>

#include "bsp/bare/board.hpp"
#include "bsp/bare/head.hpp"

namespace lasso::bare {

const std::uint32_t camera_port = kCameraPort, ground_port = kGroundPort;

Sensor& make_sensor(DriverMemory& memory, lcs::Line& camera_line) {
  return *new (memory.bytes) lcs::Driver(camera_line, lcs::Optics(design_calibration()));
}

}  // namespace lasso::bare
