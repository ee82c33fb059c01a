// Depth images: 16-bit PNG files in greyscale, as depth cameras write them.
#pragma once

#include <string>
#include <string_view>

#include "hal_sim/raw_scan.hpp"

namespace lasso::sim {

// A pinhole camera without distortion: the pixel in column u and row v, from 0, looks along ((u - cx) / fx, (v - cy) / fy, 1).
struct DepthCamera {
  double fx = 0, fy = 0;   // pixels; 0: no camera
  double cx = 0, cy = 0;   // pixels
  double scale_m = 0;      // metres in a unit of the image
  bool along_ray = false;  // its values are ranges along the rays, not depths along z
};

// A ray for each pixel, row by row: a return, or a miss where its value is 0. Without times. Throws ScanFileError: not a PNG of 16-bit
// greyscale, or damaged.
RawScan read_depth_image(const std::string& file, std::string_view bytes, const DepthCamera& camera);

}  // namespace lasso::sim
