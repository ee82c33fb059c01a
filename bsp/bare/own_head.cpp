// The head of an image for the camera's own processor: beside it, at memory that both see. The camera's line then has commands and
// telemetry, poses among it; at the other port there is nothing (docs/in-sensor.md).
#include <new>

#include "bsp/bare/board.hpp"
#include "bsp/bare/head.hpp"

namespace lasso::bare {

// By this name the rig finds it (ft/pil/boards.py). It lies in a section of its own, which start-up does not zero, as some of its words are
// the head's, and which the script of a card with a cache places where nothing is cached.
[[gnu::section(".head")]] lcs::HeadMemory head_memory;
static_assert((static_cast<void>(lcs::HeadMemory{}), true), "no constructor writes to it at start-up");

const std::uint32_t camera_port = kGroundPort, ground_port = kCameraPort;

Sensor& make_sensor(DriverMemory& memory, lcs::Line&) {
  return *new (memory.bytes) lcs::HeadDriver(head_memory, lcs::Optics(design_calibration()));
}

}  // namespace lasso::bare
