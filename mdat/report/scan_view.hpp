// Pictures of scans on the target, as the sensor sees it.
#pragma once

#include <string>
#include <vector>

#include "hal_sim/ray_caster.hpp"
#include "mdat/report/plotter.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat {

// A scan and what stands above it, \\n between two lines.
struct ScanPanel {
  const KeptScan* scan = nullptr;
  std::string title;
  Vec3 center_m = Vec3::Zero();  // point of the target at whose depth the picture is measured
};

// One panel a scan, of the shape of what it shows, side by side and below each other, times `scale`: the target shaded at the estimated
// pose, the rays that missed as grey points, the returns coloured by measured minus predicted range, the rays aimed at contours violet.
// Black are returns where the model has nothing (crosses) and misses where it is (rings).
// Panels of one size are parts of the sensor's view of equal size; otherwise each shows its own scan's. A PNG file's bytes. Throws
// PictureError.
std::string scan_view_png(Plotter& plotter, const sim::RayCaster& target, const std::vector<ScanPanel>& panels, bool one_size,
                          double scale);

// The same at its own size, as an image within a page; a line that says why, where it cannot be drawn.
std::string scan_view(Plotter& plotter, const sim::RayCaster& target, const std::vector<ScanPanel>& panels, bool one_size);

// What stands below such a picture of them.
inline constexpr char kScanLegend[] =
    "Colour: measured minus predicted range of each return; grey: rays that missed. Black: returns where the model, at this pose, has "
    "nothing (crosses), and misses where it is (rings).";

// Measured minus predicted range of a return at a pose; NaN where the ray does not meet the model there.
double residual_m(const sim::RayCaster& target, const Pose& T_sensor_target, const RangeSample& sample);

}  // namespace lasso::mdat
