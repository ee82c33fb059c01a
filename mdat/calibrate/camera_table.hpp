// The calibration that a camera was made with, asked of the camera itself (docs/icd/lcs.md).
#pragma once

#include <string>

#include "hal_lcs/triangulation.hpp"

namespace lasso::mdat {

// Opens the line (bsp/posix/serial_line.hpp), asks, and closes it; the laser stays as it is. Throws InputError that names the line: why it
// is not open, no answer within 2 s, a head without such a table, or a table that is no calibration.
lcs::Calibration read_camera_table(const std::string& address, bool remote);

}  // namespace lasso::mdat
