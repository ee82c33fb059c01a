#include "hal_sim/laser_reflection.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::sim {
namespace {

constexpr double kLeastCosine = 1e-6;  // beyond it a surface is seen edge-on

// Density of the tiny mirrors' normals at cosine c from the surface's, 1/sr.
double ggx_density(double alpha2, double c) {
  const double root = c * c * (alpha2 - 1) + 1;
  return alpha2 / (kPi * root * root);
}

// Smith's Lambda: hidden over seen area of the tiny mirrors from a direction at cosine c.
double smith_hidden(double alpha2, double c) { return (std::sqrt(1 + alpha2 * (1 - c * c) / (c * c)) - 1) / 2; }

double ggx_lobe_per_sr(const LaserReflection& surface, double cos_half, double cos_light, double cos_sensor, double cos_turn) {
  const double alpha2 = surface.roughness * surface.roughness;
  const double seen = 1 / (1 + smith_hidden(alpha2, cos_light) + smith_hidden(alpha2, cos_sensor));
  const double left = 1 - cos_turn, left2 = left * left;
  const double fresnel = surface.specular + (1 - surface.specular) * left2 * left2 * left;  // Schlick
  return fresnel * ggx_density(alpha2, cos_half) * seen / (4 * cos_light * cos_sensor);
}

}  // namespace

double backscatter(const LaserReflection& surface, double cos_incidence) {
  const double c = std::clamp(cos_incidence, kLeastCosine, 1.0);
  const double diffuse = surface.diffuse * c;
  return surface.specular == 0 ? diffuse : diffuse + kPi * c * ggx_lobe_per_sr(surface, c, c, c, 1);
}

double radiance_per_sr(const LaserReflection& surface, const Vec3& normal, const Vec3& to_light, const Vec3& to_sensor) {
  const double side = normal.dot(to_sensor) < 0 ? -1 : 1;
  const double cos_light = side * normal.dot(to_light), cos_sensor = std::max(kLeastCosine, side * normal.dot(to_sensor));
  if (cos_light <= kLeastCosine) return 0;
  const double diffuse = surface.diffuse / kPi;
  if (surface.specular == 0) return cos_light * diffuse;
  const Vec3 half = (to_light + to_sensor).normalized();
  return cos_light * (diffuse + ggx_lobe_per_sr(surface, side * normal.dot(half), cos_light, cos_sensor, half.dot(to_sensor)));
}

}  // namespace lasso::sim
