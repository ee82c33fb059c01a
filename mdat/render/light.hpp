// What lights a target in orbit, all in one frame.
#pragma once

#include <optional>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/se3.hpp"
#include "mdat/render/rgb.hpp"
#include "mdat/render/sampling.hpp"

namespace lasso::mdat {

constexpr double kSun_Wpm2 = 1361;                  // irradiance at 1 au (Kopp, Lean 2011)
constexpr double kSunHalfAngle_rad = 0.0046524;     // 0.533 deg across
constexpr double kEarthAlbedo = 0.3;                // mean Bond albedo (Stephens et al. 2015: 0.29)
constexpr double kEarthHalfAngle_rad = 1.22173048;  // asin(R/(R+h)) = 70 deg: at 408 km
constexpr double kLamp_Wpsr = 26;                   // 20 W of light in a cone of 44 deg, as service vehicles carry

constexpr double kBandShare = 0.59;  // of the sun's power between 400 and 900 nm, where silicon sees (ASTM E490)

// A lamp that is small against its distance, and shines evenly within a cone.
struct Lamp {
  Vec3 place_m = Vec3::Zero();
  double intensity_Wpsr = kLamp_Wpsr;
  Vec3 axis = Vec3::UnitZ();    // unit, of the cone
  double half_angle_rad = kPi;  // of the cone; pi: to all sides
  bool casts_shadows = true;    // false: at the camera, which sees no shadow of its lamp
};

// One at the camera, to all sides.
Lamp lamp_at_camera(double intensity_Wpsr);

// Irradiance in W/m2 of a plate at `place_m` that faces the lamp, without what is between them.
double lamp_irradiance(const Lamp& lamp, const Vec3& place_m);

// Sun, Earth and lamps. Directions are unit vectors towards sun and Earth.
struct Lights {
  std::optional<Vec3> sun;
  double sun_share = 1;  // of its disc that Earth leaves visible
  std::optional<Vec3> earth;
  double earth_half_angle_rad = kEarthHalfAngle_rad;  // (0, pi/2)
  std::vector<Lamp> lamps;
};

// The same lights as frame b has them, of those that frame a has.
Lights lights_in_frame(const Lights& lights, const Pose& T_b_a);

// Radiance of Earth's disc, W/m2/sr: evenly bright, as bright as the ground below the craft, which scatters the sun's light evenly and is
// dark where the sun is below its horizon. 0 without sun or Earth.
double earth_radiance(const Lights& lights);

// Irradiance of a plate by a disc of radiance 1/pi and half angle `half_angle_rad` (< pi/2) whose middle is at `cosine` from the plate's
// normal, cut by the plate's horizon: the view factor from a plate to a sphere (Howell, A Catalog of Radiation Heat Transfer Configuration
// Factors, B-43). 0 to 1, error <= 1e-12.
double disc_view_factor(double cosine, double half_angle_rad);

// A direction of the disc about `middle` (unit), evenly by solid angle.
Vec3 disc_direction(const Vec3& middle, double half_angle_rad, const UnitSquare& sample);

// Two unit vectors that are perpendicular to `z` (unit) and to each other; x cross y = z.
struct Tangents {
  Vec3 x, y;
};
Tangents tangents_of(const Vec3& z);

}  // namespace lasso::mdat
