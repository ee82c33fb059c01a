// What a simulated flash LIDAR is like (hal_sim/flash_lidar.hpp has the equations).
#pragma once

namespace lasso::sim {

constexpr int kMaxPixelsASide = 256;
constexpr double kFlashReflectance = 0.5;  // that photons_at_10m is of

struct FlashModel {
  int columns = 128, rows = 128;           // [8, kMaxPixelsASide], over the field of view
  double photons_at_10m = 400;             // counted of a surface of kFlashReflectance seen straight on, > 0
  double background = 0.05;                // counts within a bin, [0, 100]
  int threshold = 5;                       // counts, [1, 1000]
  double pulse_m = 0.15;                   // rms length of the pulse in range (1 ns), > 0
  double jitter_m = 0.01;                  // >= 0
  double dead_share = 0.001;               // of the pixels, the same in each frame: kInvalid; [0, 0.5]
  double reflectance = kFlashReflectance;  // of all surfaces, [0, 1]
  bool materials = false;                  // but of those that have a reflection of their own, which counts instead
  double noise_factor = 1;                 // of sigma
  bool ideal = false;                      // each pixel's middle ray, without noise; what photons there are does not count
  // What the sensor's users take one sigma of a range to be, sqrt(sigma0^2 + (k z^2)^2): a pixel's sigma_factor says how much more it is.
  double stated_sigma0_m = 0.012, stated_sigma_k_per_m = 1.4e-5;

  double bin_m() const { return 4 * pulse_m; }
};

// Throws std::invalid_argument that names the member, its value and what was expected.
void validate(const FlashModel& model);

}  // namespace lasso::sim
