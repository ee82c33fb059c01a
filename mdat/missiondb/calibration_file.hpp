// A laser camera's calibration as a file (TOML): what `mdat calibrate` writes, and runs read. Every key is that of
// TriangulationCalibration.
#pragma once

#include <filesystem>
#include <string>

#include "fsw/mission/calibration.hpp"

namespace lasso::mdat {

// Throws MissionError with all problems: a key that is missing or unknown, a value out of its range; a table that is singular, or that
// describes no volume (validate).
TriangulationCalibration load_calibration(const std::filesystem::path& file);

// The file's text; numbers read back to the same bits.
std::string calibration_text(const TriangulationCalibration& calibration);

}  // namespace lasso::mdat
