// Dust or gas that scatters a laser's light on its way: a plume, a cloud.
#pragma once

#include <cstdint>

#include "fsw/geometry/types.hpp"

namespace lasso::sim {

enum class ScatterShape : std::uint8_t { kSphere = 0, kCone = 1 };

// In its own frame: a sphere about the origin, or a cone from the origin along z, which ends at `length_m` from there. The extinction is
// even within `core_m` of the origin, and falls with the square of the distance from there on, as a plume that expands into vacuum does.
struct ScatterVolume {
  ScatterShape shape = ScatterShape::kSphere;
  double radius_m = 1;          // of the sphere, > 0
  double half_angle_rad = 0;    // of the cone, (0, pi/2)
  double length_m = 0;          // of the cone, > 0
  double extinction_per_m = 0;  // in the core, > 0
  double core_m = 0;            // > 0; not smaller than the volume: all of it is even
  double lidar_ratio_sr = 40;   // extinction over backscatter, > 0; 4 pi: scattered alike to all sides, and nothing absorbed
};

double extinction_per_m(const ScatterVolume& volume, const Vec3& place_m);

// Of the first `range_m` of a ray: the integral of the extinction, in closed form. `direction` is of unit length.
double optical_depth(const ScatterVolume& volume, const Vec3& origin_m, const Vec3& direction, double range_m);

// The range at which the depth is reached; negative: nowhere on the ray. The inverse of optical_depth.
double range_of_depth(const ScatterVolume& volume, const Vec3& origin_m, const Vec3& direction, double depth);

// What a pulse of root mean square width `width_m` gets back from the volume at this place, over what it gets from a white Lambertian
// surface at right angles there: pi extinction / lidar_ratio times 2 sqrt(pi) width, the length over which a filter that fits the pulse
// gathers.
double volume_backscatter(const ScatterVolume& volume, const Vec3& place_m, double width_m);

}  // namespace lasso::sim
