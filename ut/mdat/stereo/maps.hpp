// Small disparity maps.
#pragma once

#include "mdat/pair/disparity_map.hpp"

namespace lasso::mdat {

inline DisparityMap empty_map(int width, int height, double focal_px) {
  DisparityMap map;
  map.focal_px = focal_px;
  map.center_x_px = 0.5 * (width - 1);
  map.center_y_px = 0.5 * (height - 1);
  map.baseline_m = 0.25;
  map.codes = {width, height, std::vector<std::uint16_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0)};
  return map;
}

}  // namespace lasso::mdat
