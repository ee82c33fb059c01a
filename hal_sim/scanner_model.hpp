// What is imperfect about the simulated scanner, a laser camera or a time-of-flight LIDAR, and the draws that decide it for one ray.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/detector.hpp"
#include "hal_sim/random.hpp"

namespace lasso::sim {

// The presets are a perfect scanner with a field of view of 30 degrees. The noise along the ray is sigma_r^2 = sigma0^2 + (k z^2)^2, z the
// depth of the point along the boresight. Triangulation lives by its second term (a range's change moves the spot on the detector by less
// and less), time of flight by its first (the clock does not know how far the light went; what returns weakens with the square).
struct ScannerModel {
  double sigma0_m = 0;         // >= 0
  double sigma_k_per_m = 0;    // >= 0
  double sigma_angle_rad = 0;  // of the ray about each of two axes: the ray that is measured differs from the reported one; [0, 0.1]
  double fov_half_x_rad = 15 * kRadPerDeg;  // (0, pi/2), beside the boresight
  double fov_half_y_rad = 15 * kRadPerDeg;
  double range_min_m = 0.1;                // a return from nearer saturates: kInvalid
  double range_max_m = 1000;               // a return from farther is too weak to be seen: kMiss
  double dropout_probability = 0;          // of a return to be lost: kMiss, as the scanner cannot know why nothing came back
  double dropout_incidence_rad = kPi / 2;  // a return at a larger incidence is lost too; (0, pi/2], pi/2: none
  double outlier_probability = 0;          // of any ray to report a hit, uniform between range_min and 1.5 times the target's range
  double edge_mixing_m = 0;                // radius of the beam's footprint at range 0; with no divergence 0: no mixing at range edges
  double beam_divergence_rad = 0;          // growth of that radius with the range, [0, 0.1]
  double edge_mixing_probability = 1;      // of a mixed range where the footprint covers two surfaces
  double range_step_m = 0;                 // quantisation of the range; 0: none
  // What all rays of a scan have in common (common_error.hpp), 1 sigma: along each ray sigma + k R^2, and a turn about each sensor axis.
  double common_sigma_m = 0, common_sigma_k_per_m = 0;  // >= 0
  double common_sigma_rad = 0;                          // [0, 0.2]
  double common_memory_s = 0;                           // in which their correlation falls to 1/e; 0: new in each scan
  TimeUs dark_from_us = 0;                              // from here ...
  TimeUs dark_until_us = 0;                             // ... to before this nothing of the target is seen: kMiss
  DetectorModel detector;                               // the light that returns, and which return is told
};

// A LIDAR that times its pulses: 20 mm (20.6 mm at 100 m) from 1 m to 100 m, a beam that widens to 50 mm there.
inline ScannerModel time_of_flight_lidar() {
  ScannerModel model;
  model.sigma0_m = 0.02;
  model.sigma_k_per_m = 5e-7;
  model.range_min_m = 1;
  model.range_max_m = 100;
  model.beam_divergence_rad = 2.5e-4;
  return model;
}

bool has_common_errors(const ScannerModel& model);

// Throws std::invalid_argument that names the member, its value and what was expected.
void validate(const ScannerModel& model);

// All that chance decides for one ray. Every member is drawn whatever the model needs, so that two models with one seed share their noise.
struct RayDraws {
  double outlier, outlier_place, dropout, mixing, mixing_weight;  // uniform [0, 1)
  double tilt_x, tilt_y, range;                                   // standard normal
};
RayDraws draw(std::uint64_t seed, std::uint32_t scan_id, std::uint32_t ray);

// Radius of the beam where it has gone `range_m`.
double footprint_m(const ScannerModel& model, double range_m);

// Standard deviation along the ray of a return at depth `z_m`.
double range_sigma_m(const ScannerModel& model, double z_m);

}  // namespace lasso::sim
