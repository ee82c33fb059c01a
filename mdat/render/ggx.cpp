#include "mdat/render/ggx.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

constexpr double kFullGrazing = 0.02;  // F0 from which all is reflected at grazing (Lagarde, de Rousiers 2014)

Rgb grazing(const Rgb& specular) { return (specular / kFullGrazing).min(1.0); }

// Smith's Lambda of a direction whose cosine is > 0.
double lambda(double cosine, double alpha) {
  const double tan2 = (1 - cosine * cosine) / (cosine * cosine);
  return 0.5 * (std::sqrt(1 + alpha * alpha * std::max(0.0, tan2)) - 1);
}

double facet_density(double cosine, double alpha) {
  const double a2 = alpha * alpha, d = cosine * cosine * (a2 - 1) + 1;
  return a2 / (kPi * d * d);
}

// A share to divide by: where facets reflect all, there is no diffuse light either.
constexpr double kLeastPassed = 1e-9;

// Mean of 1 - fresnel over the hemisphere by cosine: the integral of 2 c (1 - c)^5 is 1/21.
Rgb mean_passed(const Rgb& specular) { return (1 - specular - (grazing(specular) - specular) / 21).max(kLeastPassed); }

}  // namespace

Rgb fresnel(const Rgb& specular, double cosine) {
  const double m = 1 - std::min(1.0, std::max(0.0, cosine)), m2 = m * m;
  return specular + (grazing(specular) - specular) * (m2 * m2 * m);
}

Rgb diffusely_reflected(const Reflection& surface, const Vec3& view) {
  return surface.diffuse * (1 - fresnel(surface.specular, view.z())) / (kPi * (1 - surface.specular).max(kLeastPassed));
}

Rgb reflected(const Reflection& surface, const Vec3& view, const Vec3& light) {
  if (!(view.z() > 0) || !(light.z() > 0)) return Rgb::Zero();
  const Vec3 half = (view + light).normalized();
  const Rgb diffuse = diffusely_reflected(surface, view) * (1 - fresnel(surface.specular, light.z())) / mean_passed(surface.specular);
  const double shown = 1 / (1 + lambda(view.z(), surface.roughness) + lambda(light.z(), surface.roughness));
  const double facets = facet_density(half.z(), surface.roughness) * shown / (4 * view.z() * light.z());
  return diffuse + fresnel(surface.specular, view.dot(half)) * facets;
}

Mirrored mirrored(const Reflection& surface, const Vec3& view, const UnitSquare& sample) {
  const double alpha = surface.roughness;
  const Vec3 stretched = Vec3(alpha * view.x(), alpha * view.y(), view.z()).normalized();
  const double across = std::sqrt(stretched.x() * stretched.x() + stretched.y() * stretched.y());
  const Vec3 t1 = across > 1e-9 ? Vec3(-stretched.y() / across, stretched.x() / across, 0) : Vec3::UnitX();
  const Vec3 t2 = stretched.cross(t1);
  const SinCos turn = sin_cos(2 * kPi * sample.v);
  const double r = std::sqrt(sample.u), x = r * turn.cos, s = 0.5 * (1 + stretched.z());
  const double y = (1 - s) * std::sqrt(std::max(0.0, 1 - x * x)) + s * r * turn.sin;
  const Vec3 on_disc = x * t1 + y * t2 + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
  const Vec3 facet = Vec3(alpha * on_disc.x(), alpha * on_disc.y(), std::max(1e-9, on_disc.z())).normalized();
  const double cosine = view.dot(facet);
  Mirrored result;
  result.light = 2 * cosine * facet - view;
  if (!(result.light.z() > 0)) return result;  // onto the surface again: lost
  const double of_view = lambda(view.z(), alpha);
  result.share = fresnel(surface.specular, cosine) * ((1 + of_view) / (1 + of_view + lambda(result.light.z(), alpha)));
  return result;
}

}  // namespace lasso::mdat
