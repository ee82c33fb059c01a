// How much of a laser's light a surface sends back to where it came from.
#pragma once

#include "fsw/geometry/types.hpp"

namespace lasso::sim {

// At the laser's wavelength. The specular lobe is that of tiny mirrors whose slopes are distributed after GGX, with Smith's shadowing
// (Walter, Marschner, Li, Torrance 2007).
struct LaserReflection {
  double diffuse = 1;    // share that is scattered alike to all sides (Lambert), [0, 1]
  double specular = 0;   // share that the tiny mirrors reflect at right angles, [0, 1]
  double roughness = 1;  // alpha of GGX, (0, 1]
};

// What a beam gets back at this cosine of its incidence, (0, 1], over what it gets from a white Lambertian surface at right angles: pi
// times the bidirectional reflectance into the beam's own direction, times the cosine. It is diffuse cos(i) and a lobe that is
// specular / (4 roughness^2) at i = 0: a mirror returns more than the white surface there, and next to nothing elsewhere.
double backscatter(const LaserReflection& surface, double cos_incidence);

// Radiance towards `to_sensor` over the irradiance at right angles to `to_light`, 1/sr; unit vectors away from the surface. Both sides of
// a surface reflect; light that falls on the side that is not seen gives 0.
double radiance_per_sr(const LaserReflection& surface, const Vec3& normal, const Vec3& to_light, const Vec3& to_sensor);

}  // namespace lasso::sim
