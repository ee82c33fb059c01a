// Radiance of what a ray meets.
#pragma once

#include <cstdint>
#include <vector>

#include "mdat/render/light.hpp"
#include "mdat/render/material.hpp"
#include "mdat/render/model_surface.hpp"

namespace lasso::mdat {

// A ray of a picture: sample `index` of a pixel, and how wide the pixel is at a range of 1 m.
struct PictureRay {
  Vec3 origin_m, direction;
  double pixel_rad = 0;
  PixelSamples samples{0, 1};
  int index = 0;
};

// Sun with shadows (a disc, so that they have soft edges), lamps with sharp ones, Earth's disc with shadows, and one mirror reflection of
// what is around, Earth or the target itself. Light that is scattered from one part to another more than once is not there. All in the
// target's frame.
class Shader {
 public:
  // Keeps the surface by reference. `materials`: one for each part.
  Shader(const ModelSurface& surface, std::vector<Material> materials, const Lights& lights);

  // W/m2/sr; of a ray that meets nothing false, and black. `point` gets what it meets.
  bool radiance(const PictureRay& ray, SurfacePoint& point, Rgb& radiance) const;

 private:
  struct Local;
  Local local_at(const SurfacePoint& point, const Vec3& direction, double footprint_m) const;
  void lean(const SurfacePoint& point, double footprint_m, const Material& material, Local& local) const;
  double shade(const SurfacePoint& point, const Vec3& normal_target, const Material& material, double footprint_m,
               double& line_share) const;
  Rgb from_sun(const Local& local, const PictureRay& ray, std::uint32_t purpose) const;
  Rgb from_lamp(const Lamp& lamp, const Local& local) const;
  Rgb from_lamps(const Local& local) const;
  Rgb from_earth(const Local& local, const PictureRay& ray, std::uint32_t purpose) const;
  Rgb mirrored_in(const Local& local, const PictureRay& ray) const;
  double mirrored_earth(const Local& local) const;

  const ModelSurface& surface_;
  std::vector<Material> materials_;
  Lights lights_;
  double earth_Wpm2sr_;
  std::vector<double> earth_factors_;  // view factors by the cosine, from -1 to 1
};

}  // namespace lasso::mdat
