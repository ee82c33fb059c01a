// A script of what goes wrong with the simulated laser camera and its line, as a person writes it: docs/user-guide.md.
#pragma once

#include <filesystem>

#include "hal_sim/lcs_faults.hpp"

namespace lasso::mdat {

// In the order of the file; times since frame 0. Throws MissionError with all problems.
sim::LcsFaults load_camera_faults(const std::filesystem::path& file);

}  // namespace lasso::mdat
