// What a run's stereo cameras take for one scan: for who records it.
#pragma once

#include <string>

#include "fsw/core/time.hpp"
#include "mdat/missiondb/stereo_pair_file.hpp"

namespace lasso::mdat {

struct TakenPair {
  TimeUs t_us = 0;                  // mission time of both pictures
  StereoPair stated;                // what the calibration says: the left camera's frame is the sensor's own
  std::string left_png, right_png;  // grey, 8 bits
};

}  // namespace lasso::mdat
