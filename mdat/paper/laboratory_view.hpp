// The part of the page about the laboratory test: what was assumed, the budget, and what came out.
#pragma once

#include <string>

#include "mdat/paper/experiments.hpp"
#include "mdat/report/plotter.hpp"

namespace lasso::mdat {

std::string laboratory_section(Plotter& plotter, const LaboratoryResult& laboratory);

}  // namespace lasso::mdat
