#include "mdat/render/light.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {

Lamp lamp_at_camera(double intensity_Wpsr) {
  Lamp lamp;
  lamp.intensity_Wpsr = intensity_Wpsr;
  lamp.casts_shadows = false;
  return lamp;
}

double lamp_irradiance(const Lamp& lamp, const Vec3& place_m) {
  const Vec3 way_m = lamp.place_m - place_m;
  const double range2_m2 = way_m.squaredNorm();
  const bool all_around = lamp.half_angle_rad >= kPi;
  if (!all_around && -way_m.dot(lamp.axis) < sin_cos(lamp.half_angle_rad).cos * std::sqrt(range2_m2)) return 0;
  return lamp.intensity_Wpsr / range2_m2;
}

Lights lights_in_frame(const Lights& lights, const Pose& T_b_a) {
  Lights turned = lights;
  if (lights.sun) turned.sun = rotate(T_b_a.q, *lights.sun);
  if (lights.earth) turned.earth = rotate(T_b_a.q, *lights.earth);
  for (Lamp& lamp : turned.lamps) {
    lamp.place_m = T_b_a * lamp.place_m;
    lamp.axis = rotate(T_b_a.q, lamp.axis);
  }
  return turned;
}

double earth_radiance(const Lights& lights) {
  if (!lights.sun || !lights.earth) return 0;
  const double height = -lights.earth->dot(*lights.sun);  // of the sun above the ground below: its sine
  return height > 0 ? kEarthAlbedo * kSun_Wpm2 * height / kPi : 0;
}

double disc_view_factor(double cosine, double half_angle_rad) {
  const SinCos half = sin_cos(half_angle_rad);
  const double size = half.sin * half.sin;
  if (cosine >= half.sin) return size * cosine;  // all above the horizon
  if (cosine <= -half.sin) return 0;
  const double sine = std::sqrt(1 - cosine * cosine);
  const double cot = half.cos / half.sin;  // sqrt(h^2 - 1), h the distance in radii
  const double edge = clamp(-cot * cosine / sine, -1, 1);
  const double cut = std::sqrt(std::max(0.0, 1 - cosine * cosine / size));
  return 0.5 - arc_sine(clamp(half.cos / sine, -1, 1)) / kPi + size / kPi * (cosine * (kPi / 2 - arc_sine(edge)) - cot * cut);
}

Tangents tangents_of(const Vec3& z) {
  const Vec3 other = std::fabs(z.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 x = other.cross(z).normalized();
  return {x, z.cross(x)};
}

Vec3 disc_direction(const Vec3& middle, double half_angle_rad, const UnitSquare& sample) {
  const double half_sine = sin_cos(0.5 * half_angle_rad).sin;
  const double down = 2 * half_sine * half_sine * sample.u;  // 1 - cosine; the difference itself would lose digits
  const SinCos turn = sin_cos(2 * kPi * sample.v);
  const double sine = std::sqrt(down * (2 - down));
  const Tangents side = tangents_of(middle);
  return (1 - down) * middle + sine * turn.cos * side.x + sine * turn.sin * side.y;
}

}  // namespace lasso::mdat
