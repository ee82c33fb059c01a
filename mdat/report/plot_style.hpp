// What all figures look like.
#pragma once

#include <string>

namespace lasso::mdat {

constexpr const char* kPlotStyle =
    "set border 3 lc rgb '#8a94a3'\nset tics nomirror out scale 0.5 textcolor '#46505f'\nset grid lc rgb '#e3e7ed' lt 1 lw 0.7\n"
    "set key textcolor '#2b3440'\nset title textcolor '#2b3440'\n";

// gnuplot draws nothing of no point: says why there is none.
inline std::string nothing_to_draw(const std::string& why) {
  return kPlotStyle + ("set yrange [-1:1]\nunset key\nset label 1 '" + why + "' at graph 0.5,0.5 center\nplot -2 notitle\n");
}

}  // namespace lasso::mdat
