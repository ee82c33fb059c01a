// What the comparison says on the terminal, and leaves for programs.
#pragma once

#include <string>

#include "mdat/availability/figures.hpp"

namespace lasso::mdat {

std::string comparison_text(const HeadComparison& comparison);
std::string comparison_json(const HeadComparison& comparison);
// A line for each frame of the approach and each sample of an orbit, with its light (docs/availability.md has the columns).
std::string comparison_csv(const HeadComparison& comparison);

// One sentence.
std::string laser_text(LaserInLight laser);

// "31/40 (78 %)"
std::string count_text(const FrameFigures& figures);

}  // namespace lasso::mdat
