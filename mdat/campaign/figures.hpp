// What a campaign keeps of a case: one number a column, from all its frames.
#pragma once

#include <string>
#include <vector>

#include "mdat/run/case.hpp"

namespace lasso::mdat {

struct Figure {
  const char* name;     // the column, with its unit
  const char* meaning;  // for a person
  double (*of)(const CaseResult& result);
};

// In the order of the columns. What a case does not have (an error where no pose is valid) is not a number. Errors are those of the
// registration's valid poses, the wrong ones included; percentiles by nearest rank.
const std::vector<Figure>& case_figures();

// A figure's number as cells of tables have it: the shortest text that reads back to the same double; empty where it is not a number.
std::string cell_text(double value);

}  // namespace lasso::mdat
