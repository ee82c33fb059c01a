// A camera's detector: from the radiance in each pixel to the numbers that the camera reads out, with the noise of light and electronics.
#pragma once

#include <cstdint>
#include <vector>

namespace lasso::mdat {

// A scientific CMOS detector behind a lens. Where light falls evenly, a pixel has radiance * electrons_per_radiance(imager) * exposure
// electrons: E = pi L / (4 N^2) is the irradiance behind a lens of f-number N that looks at a far surface of radiance L.
struct Imager {
  double f_number = 8;
  double transmission = 0.8;         // of the lens
  double pixel_m = 5.5e-6;           // pitch
  double quantum_efficiency = 0.45;  // electrons for each photon, mean over the band
  double photon_J = 3.06e-19;        // energy of a photon of 650 nm
  double full_well_e = 20000;
  double read_noise_e = 8;
  double dark_eps = 20;  // dark current, electrons a second
  double prnu = 0.01;    // spread of the pixels' response, relative, 1 sigma
  double psf_px = 0.6;   // of the lens, a Gaussian
  double glare = 0.01;   // share of the light that the lens scatters widely: a Gaussian, too
  double glare_px = 25;
  int bits = 12;  // of a number that is read out; the greatest stands for the full well
};

// Greatest number that is read out.
inline int greatest_number(const Imager& imager) { return (1 << imager.bits) - 1; }

// Electrons in a second for each W/m2/sr.
double electrons_per_radiance(const Imager& imager);

// One value for each pixel, row by row from the top.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<double> values;
};

// What the lens makes of it: a sharp kernel and a wide one, both of sum 1. Beyond the picture nothing shines. The wide kernel is computed
// on means of 8 x 8 pixels.
GreyImage through_lens(const GreyImage& radiance, const Imager& imager);

// What was read out.
struct RawFrame {
  int width = 0, height = 0;
  double exposure_s = 0;
  std::vector<std::uint16_t> numbers;
};

// Draws depend on these two alone: pixels respond as `camera` says in each frame, the rest is drawn for `frame`.
struct ImagerSeeds {
  std::uint64_t camera = 0, frame = 0;
};

// A global shutter: response of each pixel, shot noise, full well, read noise, rounding. `focused`: what through_lens gave.
RawFrame exposed(const GreyImage& focused, const Imager& imager, double exposure_s, const ImagerSeeds& seeds);

// A number of codes that a matcher takes: code = 255 sqrt(number / greatest), rounded, so that shot noise is the same number of codes at
// any brightness.
std::vector<std::uint8_t> square_root_codes(const RawFrame& frame, int greatest);

}  // namespace lasso::mdat
