#include "mdat/scene/orbit.hpp"

#include <cmath>
#include <string>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/scan_text.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kHighest_m = 1e9;  // beyond, the Earth no longer covers the Sun's disc

// Share of a disc of radius `disc` that a circle of radius `limb`, larger than it, leaves uncovered; the disc's centre lies `clearance`
// outside the circle's edge. Overlap of two circles in a plane, without the cancellation of a large radius.
double uncovered_share(double clearance, double disc, double limb) {
  if (clearance >= disc) return 1;
  if (clearance <= -disc) return 0;
  const double to_chord = (clearance * (2 * limb + clearance) + disc * disc) / (2 * (limb + clearance));
  const double half_chord = square_root(disc * disc - to_chord * to_chord);
  const double limb_to_chord = limb + clearance - to_chord;
  const double of_disc = disc * disc * arc_tangent2(half_chord, to_chord) - to_chord * half_chord;
  const double of_limb = limb * limb * arc_tangent2(half_chord, limb_to_chord) - limb_to_chord * half_chord;
  return clamp(1 - (of_disc + of_limb) / (kPi * disc * disc), 0, 1);
}

}  // namespace

Quat q_hill_lvlh() {
  Mat3 R;  // columns: V-bar, against the angular momentum, R-bar
  R << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  return to_quaternion(R);
}

double beta_angle_rad(double inclination_rad, double ascending_node_rad, double sun_right_ascension_rad, double sun_declination_rad) {
  const SinCos i = sin_cos(inclination_rad), declination = sin_cos(sun_declination_rad);
  return arc_sine(
      clamp(declination.cos * i.sin * sin_cos(ascending_node_rad - sun_right_ascension_rad).sin + declination.sin * i.cos, -1, 1));
}

Orbit::Orbit(const Setup& setup, const Place& place) : setup_(setup) {
  Problems problems(place);
  const std::string altitude = sim::text_of(setup.altitude_m) + " m";
  if (setup.altitude_m <= 0) {
    problems.add("altitude", altitude, "is below the ground: expected metres above the Earth's mean radius, more than 0");
  } else {
    problems.require(setup.altitude_m <= kHighest_m, "altitude", altitude, "expected at most 1e9 m");
  }
  problems.require(std::fabs(setup.beta_rad) <= kPi / 2, "beta", sim::text_of(setup.beta_rad) + " rad",
                   "expected an elevation of the Sun above the orbit plane from -90 to 90 deg");
  problems.require(std::isfinite(setup.angle_rad), "angle", sim::text_of(setup.angle_rad), "expected a finite angle from orbit noon");
  problems.throw_if_any();
  mean_motion_radps_ = square_root(kEarthGravity_m3ps2 / radius_m()) / radius_m();
  const SinCos beta = sin_cos(setup.beta_rad);
  cos_beta_ = beta.cos;
  sin_beta_ = beta.sin;
}

double Orbit::period_s() const { return 2 * kPi / mean_motion_radps_; }

double Orbit::angle_rad(TimeUs t_us) const { return std::remainder(setup_.angle_rad + mean_motion_radps_ * to_seconds(t_us), 2 * kPi); }

Vec3 Orbit::sun_hill(TimeUs t_us) const {
  const SinCos angle = sin_cos(angle_rad(t_us));
  return {cos_beta_ * angle.cos, -cos_beta_ * angle.sin, sin_beta_};
}

Vec3 Orbit::sun_rate_hill_radps(TimeUs t_us) const { return sun_hill(t_us).cross(Vec3(0, 0, mean_motion_radps_)); }

// The limb near the Sun's disc is a circle of the sphere of directions with angular radius rho. In the plane that touches this sphere at
// the limb its radius is tan(rho).
double Orbit::sunlit_share(TimeUs t_us) const {
  const Vec3 sun = sun_hill(t_us);
  const double from_nadir_rad = arc_tangent2(square_root(sun.y() * sun.y() + sun.z() * sun.z()), -sun.x());
  const double limb_rad = arc_sine(kEarthRadius_m / radius_m());
  return uncovered_share(from_nadir_rad - limb_rad, arc_sine(kSunRadius_m / kSunDistance_m), tangent(limb_rad));
}

Earthshine Orbit::earthshine(TimeUs t_us) const {
  return {-Vec3::UnitX(), arc_sine(kEarthRadius_m / radius_m()), std::fmax(sun_hill(t_us).x(), 0)};
}

}  // namespace lasso::mdat::scene
