// Reflection by a rough surface: a GGX distribution of microfacets (Walter et al. 2007) with Smith's height-correlated masking (Heitz 2014)
// over a diffuse ground that gets what the facets let through (Shirley et al. 1997). Directions are unit vectors away from the surface, in
// the surface's frame, whose z is its normal.
#pragma once

#include "fsw/geometry/types.hpp"
#include "mdat/render/rgb.hpp"
#include "mdat/render/sampling.hpp"

namespace lasso::mdat {

struct Reflection {
  Rgb diffuse = Rgb::Zero();   // share of perpendicular light that is scattered evenly into all directions
  Rgb specular = Rgb::Zero();  // share of perpendicular light that the facets reflect; 0: there are none. diffuse + specular <= 1
  double roughness = 0.5;      // alpha of GGX, (0, 1]
};

// Share that a facet reflects (Schlick 1994). At grazing it is all, but for surfaces that reflect less than 2 % (none where F0 is 0).
Rgb fresnel(const Rgb& specular, double cosine);

// Radiance that leaves towards `view` for each irradiance that comes from `light`, 1/sr. Zero below the surface. Reciprocal; the whole
// reflected by any view is at most 1.
Rgb reflected(const Reflection& surface, const Vec3& view, const Vec3& light);

// The diffuse part alone of light that comes from all of a wide source: radiance for each irradiance, 1/sr.
Rgb diffusely_reflected(const Reflection& surface, const Vec3& view);

// A direction from which light is mirrored towards `view`, drawn by the facets that are seen (Heitz 2018), and the share of its radiance
// that leaves. Their mean over the unit square is the specular reflection of what is around.
struct Mirrored {
  Vec3 light = Vec3::UnitZ();
  Rgb share = Rgb::Zero();
};
Mirrored mirrored(const Reflection& surface, const Vec3& view, const UnitSquare& sample);

}  // namespace lasso::mdat
