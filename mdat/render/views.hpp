// Pictures of what is seen besides its light, each with a legend below, and marks of a scan on a picture.
#pragma once

#include <string>
#include <vector>

#include "fsw/sense/range_image.hpp"
#include "mdat/render/picture.hpp"
#include "mdat/render/render.hpp"

namespace lasso::mdat {

// Depth along the boresight, near dark blue to far yellow, over the depths that are seen.
Picture depth_view(const std::vector<SeenPoint>& seen, const Camera& camera);

// Depth along the boresight in whole millimetres, 0 where nothing is seen, as depth cameras write it. Throws InputError above 65.535 m.
std::vector<std::uint16_t> depth_mm(const std::vector<SeenPoint>& seen);

// Red: the normal to the right; green: upwards; blue: towards the camera.
Picture normals_view(const std::vector<SeenPoint>& seen, const Camera& camera);

// A colour for each part; the legend names those that are seen.
Picture parts_view(const std::vector<SeenPoint>& seen, const Camera& camera, const std::vector<std::string>& names);

// A ray of a scan, and what came back.
struct ScanMark {
  Vec3 direction = Vec3::UnitZ();  // sensor frame
  RayState state = RayState::kMiss;
  bool aimed = false;     // it left the pattern for a contour
  double residual_m = 0;  // of a return: measured minus predicted range; NaN: the model is not there
};

// Dots for rays: returns green, misses grey, those aimed at contours violet, without statement red; with a legend.
Picture scan_view(const Picture& picture, const Camera& camera, const std::vector<ScanMark>& marks);

// The picture darkened, the returns coloured by their residuals, white where the model has nothing; with a legend.
Picture residual_view(const Picture& picture, const Camera& camera, const std::vector<ScanMark>& marks);

}  // namespace lasso::mdat
