// A campaign's results and conclusions in files for other programs. The same results give the same bytes: no times, no machine.
#pragma once

#include <string>

#include "mdat/campaign/findings.hpp"

namespace lasso::mdat {

// CSV (RFC 4180, lines end with a line feed): case, status, the figures, the drawn values. Numbers as the shortest text that reads back to
// the same double; an empty cell is not a number.
std::string results_csv(const ResultTable& table);

// Conclusions with their limits, worst cases, correlations.
std::string summary_json(const Findings& all);

// JUnit: a test case a criterion, which fails unless it is met, and one of cases that failed to run or are missing, which is an error.
std::string junit_xml(const Findings& all);

}  // namespace lasso::mdat
