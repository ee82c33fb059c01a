// The small mission that the image fuzzer starts from: a box in cells so large that its image has a few kilobytes, and a scan of it.
#pragma once

#include "ut/support/box_image.hpp"
#include "ut/support/box_scan.hpp"

namespace lasso::fuzz {

inline test::BoxModel small_box() {
  test::BoxModel box;
  box.cell_m = 0.1;
  box.margin_m = 0.05;
  return box;
}

inline Pose small_start() { return test::generic_box_pose(); }

inline std::unique_ptr<RangeImage> small_scan() {
  test::BoxScan scan;
  scan.model = small_box();
  scan.T_sensor_target = small_start();
  scan.side = 10;
  scan.half_angle = 0.12;
  scan.sigma_m = 0.003;
  test::Generator random(1);
  return test::scan_box(scan, random);
}

}  // namespace lasso::fuzz
