// The figures that the 3DLASSO paper of 2005 states for its simulation (table 1): six ranges of 2 to 7 m, 360 frames each, no noise.
#pragma once

#include "mdat/run/statistics.hpp"

namespace lasso::mdat {

// X, Y, Z in mm; yaw, pitch, roll in degrees. The paper does not state what our rms and bounds say.
inline ErrorStatistics paper_table_1() {
  ErrorStatistics table;
  table.x_mm = {0.53, 4.87};
  table.y_mm = {3.33, 2.79};
  table.z_mm = {-3.36, 6.25};
  table.yaw_deg = {0.01, 0.20};
  table.pitch_deg = {-0.004, 0.19};
  table.roll_deg = {0.004, 0.16};
  return table;
}

}  // namespace lasso::mdat
