// What all figures look like.
#pragma once

namespace lasso::mdat {

constexpr const char* kPlotStyle =
    "set border 3 lc rgb '#8a94a3'\nset tics nomirror out scale 0.5 textcolor '#46505f'\nset grid lc rgb '#e3e7ed' lt 1 lw 0.7\n"
    "set key textcolor '#2b3440'\nset title textcolor '#2b3440'\n";

}  // namespace lasso::mdat
