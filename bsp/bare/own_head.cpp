// The head of an image for the camera's own processor: beside it, at memory that both see. The camera's line then has commands and
// telemetry, poses among it; at the other port there is nothing (docs/in-sensor.md).
#include <new>

#include "bsp/bare/board.hpp"
#include "bsp/bare/head.hpp"
#include "hal_lcs/head_driver.hpp"

namespace lasso::bare {

lcs::HeadMemory head_memory;  // by this name the rig finds it (ft/pil/boards.py)

namespace {

alignas(lcs::HeadDriver) std::uint8_t driver_memory[sizeof(lcs::HeadDriver)];

}  // namespace

const std::uint32_t camera_port = kGroundPort, ground_port = kCameraPort;

Sensor& make_sensor(lcs::Line&) { return *new (driver_memory) lcs::HeadDriver(head_memory, lcs::Optics(design_calibration())); }

}  // namespace lasso::bare
