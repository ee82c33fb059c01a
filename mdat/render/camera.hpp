// A pinhole camera without distortion at the origin of the sensor frame (z boresight, x right, y down), with square pixels.
#pragma once

#include "fsw/geometry/types.hpp"

namespace lasso::mdat {

struct Camera {
  int width = 0, height = 0;
  double focal_px = 1;
  double center_x = 0, center_y = 0;  // pixels; the middle of a pixel has whole coordinates, the first one 0

  // Unit vector through a point of the picture.
  Vec3 direction(double column, double row) const {
    return Vec3((column - center_x) / focal_px, (row - center_y) / focal_px, 1).normalized();
  }
  // Where a point before the camera (z > 0) is seen: column and row.
  Eigen::Vector2d pixel(const Vec3& point_m) const {
    return {center_x + focal_px * point_m.x() / point_m.z(), center_y + focal_px * point_m.y() / point_m.z()};
  }
};

struct PictureSize {
  int width = 0, height = 0;
};

// The field of view, half angles beside and above the boresight, just fits into the picture. One that is not of its shape shows more at
// two sides.
Camera camera_of(PictureSize size, double fov_half_x_rad, double fov_half_y_rad);

// The shape of the field of view, its longer side `longest` pixels.
PictureSize size_of(int longest, double fov_half_x_rad, double fov_half_y_rad);

}  // namespace lasso::mdat
