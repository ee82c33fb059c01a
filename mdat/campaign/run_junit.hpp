// What a run shows of its acceptance criteria, as JUnit: the form that servers of continuous integration show.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/campaign_source.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// "p95_mm <= 5": a figure of a case (docs/user-guide.md), <= or >=, a number. Throws InputError that names what was expected.
Criterion required_criterion(const std::string& text);

// A test case for each criterion and each run of each variant: that no valid pose is wrong, and what is required. A figure that is not a
// number fails, as in a campaign. The same bytes for the same results.
std::string run_junit_xml(const SimulationResult& result, const std::vector<Criterion>& required);

}  // namespace lasso::mdat
