// From a rectified pair to disparities.
#pragma once

#include "mdat/match/rectification.hpp"
#include "mdat/pair/disparity_map.hpp"

namespace lasso::mdat {

// Depths between which a match is looked for.
struct DepthWindow {
  double nearest_m = 0, farthest_m = 0;  // 0 < nearest < farthest
};

// Semi-global matching along eight paths (Hirschmüller 2008, as OpenCV has it), both ways, without what the masks refuse (masks.hpp). A
// pure function of the pictures, the calibration and the window.
DisparityMap matched(const RectifiedPair& pictures, const Rectification& cameras, const PairCodes& codes, const DepthWindow& window);

// Reads, rectifies and matches. Throws std::runtime_error or MissionError, one line each: a picture of another size than the calibration
// says, cameras that see nothing in common in this window, what the readers refuse.
struct MatchInput {
  std::filesystem::path left, right, calibration;
  DepthWindow window;
};
DisparityMap matched_files(const MatchInput& input);

}  // namespace lasso::mdat
