// A campaign's summary for the terminal.
#pragma once

#include <string>

#include "mdat/campaign/findings.hpp"

namespace lasso::mdat {

// Verdicts, the worst cases with their commands, and what goes with bad cases. Lines, the last one ended.
std::string summary_text(const Findings& all);

// Said instead of times to alert and protection levels.
constexpr char kNoCounts[] = "Times to alert and protection levels are not known: the mdat that flew this campaign did not keep them.";

// "p < 0.001", "p = 0.02".
std::string probability_text(double probability);

}  // namespace lasso::mdat
