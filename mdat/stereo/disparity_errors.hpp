// Disparities against those of the simulated target. Of what a matcher may not know: for reports alone.
#pragma once

#include <vector>

#include "mdat/pair/disparity_map.hpp"
#include "mdat/render/model_surface.hpp"

namespace lasso::mdat {

// The disparity of what each pixel of the map truly shows, 0 for sky. `T_sensor_target`: the sensor's frame is the left camera's.
std::vector<double> true_disparities(const DisparityMap& map, const ModelSurface& surface, const Pose& T_sensor_target);

constexpr int kEdgeBand_px = 5;     // about an edge of depth, in rows and columns
constexpr double kEdgeStep = 0.03;  // relative change of depth within the band that is an edge
constexpr double kWrong_px = 1;

struct DisparityErrors {
  std::size_t target = 0;                     // pixels that show it
  std::size_t valid = 0;                      // pixels with a disparity
  double valid_share = 0;                     // of the target's pixels
  double sky_share = 0;                       // of the valid pixels
  double bias_px = 0;                         // median in the interior: measured minus true
  double sigma_px = 0;                        // 1.4826 times the median deviation from it
  double wrong_interior = 0, wrong_edge = 0;  // shares of the valid pixels there that are off by more than kWrong_px
};
DisparityErrors disparity_errors(const DisparityMap& map, const std::vector<double>& truth_px);

}  // namespace lasso::mdat
