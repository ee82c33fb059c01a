#include <cstdio>

#include "mdat/cli/commands.hpp"
#include "mdat/report/plotter.hpp"

namespace lasso::mdat {

void warn_of_plotter() {
  const std::string why = why_no_plotter();
  if (!why.empty()) std::fprintf(stderr, "warning: pictures will be missing, all else is done: %s\n", why.c_str());
}

}  // namespace lasso::mdat
