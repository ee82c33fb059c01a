// A circular orbit about a spherical Earth, and its light: the Sun's direction, eclipse, earthshine.
//
// The frame of the orbit is the Hill frame (CCSDS: RTN, also RSW): x radial, away from the Earth; y along the track; z across it, along
// the orbit's angular momentum. It turns with the orbit. Docking's LVLH frame has other axes: x along the track (V-bar), y against the
// angular momentum, z towards the Earth (R-bar).
//
// Not modelled: the Earth's flattening and atmosphere, drift of the orbit and of the Sun (1 deg a day), the Sun's changing distance (its
// disc by 1.7 %) and its parallax in the orbit (1 % of its radius).
#pragma once

#include "mdat/scene/motion.hpp"

namespace lasso::mdat::scene {

constexpr double kEarthRadius_m = 6371008.8;            // mean radius R1 of the IUGG
constexpr double kEarthGravity_m3ps2 = 3.986004418e14;  // WGS 84
constexpr double kSunRadius_m = 6.957e8;                // IAU 2015, nominal
constexpr double kSunDistance_m = 149597870700;         // one astronomical unit

Quat q_hill_lvlh();  // takes coordinates of docking's LVLH frame to those of the Hill frame

// The Sun's elevation above the orbit plane, on the side of the angular momentum, from angles in one equatorial frame.
double beta_angle_rad(double inclination_rad, double ascending_node_rad, double sun_right_ascension_rad, double sun_declination_rad);

// The Earth as a lamp: a disc of uniform radiance lit * albedo * irradiance of the Sun / pi.
struct Earthshine {
  Vec3 direction_hill = -Vec3::UnitX();  // unit, towards the middle of the disc
  double half_angle_rad = 0;
  double lit = 0;  // cosine of the Sun's zenith angle below the orbit's origin, 0 at night
};

class Orbit {
 public:
  struct Setup {
    double altitude_m = 400e3;  // above the mean radius, more than 0 and at most 1e9
    double beta_rad = 0;        // the Sun's elevation above the orbit plane, within a quarter turn
    double angle_rad = 0;       // of the orbit's origin from orbit noon at t = 0, along the track
  };
  explicit Orbit(const Setup& setup, const Place& place = {});  // throws MissionError with all problems

  double radius_m() const { return kEarthRadius_m + setup_.altitude_m; }
  double mean_motion_radps() const { return mean_motion_radps_; }
  double period_s() const;

  Vec3 sun_hill(TimeUs t_us) const;             // unit, towards the Sun
  Vec3 sun_rate_hill_radps(TimeUs t_us) const;  // its derivative in the Hill frame
  // Share of the Sun's disc that the Earth leaves visible at the orbit's origin: 1 in sunlight, 0 in umbra. Error below 1e-4.
  double sunlit_share(TimeUs t_us) const;
  Earthshine earthshine(TimeUs t_us) const;

 private:
  double angle_rad(TimeUs t_us) const;

  Setup setup_;
  double mean_motion_radps_ = 0;
  double cos_beta_ = 1, sin_beta_ = 0;
};

}  // namespace lasso::mdat::scene
