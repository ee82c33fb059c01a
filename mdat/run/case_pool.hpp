// Many cases, run on all cores.
#pragma once

#include <vector>

#include "mdat/common/progress_bar.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat {

// The results of the cases in their order, whoever ran them; `jobs` at a time. `bar` is shown the frames that are flown. Throws what the
// first case that failed threw.
std::vector<CaseResult> run_cases(const std::vector<CaseSetup>& cases, unsigned jobs, ProgressBar& bar);

}  // namespace lasso::mdat
