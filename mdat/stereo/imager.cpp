#include "mdat/stereo/imager.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/random.hpp"
#include "mdat/stereo/blur.hpp"
#include "mdat/stereo/shot_noise.hpp"

namespace lasso::mdat {
namespace {

constexpr int kGlareBlock = 8;  // pixels of the coarse picture on which the wide kernel is computed
constexpr std::uint32_t kResponse = 1, kReading = 2;

}  // namespace

double electrons_per_radiance(const Imager& imager) {
  const double irradiance = kPi / (4 * imager.f_number * imager.f_number);  // W/m2 for each W/m2/sr
  return irradiance * imager.pixel_m * imager.pixel_m * imager.transmission * imager.quantum_efficiency / imager.photon_J;
}

GreyImage through_lens(const GreyImage& radiance, const Imager& imager) {
  GreyImage sharp = gaussian_blur(radiance, imager.psf_px);
  if (imager.glare <= 0) return sharp;
  const GreyImage wide =
      enlarged(gaussian_blur(reduced(radiance, kGlareBlock), imager.glare_px / kGlareBlock), kGlareBlock, radiance.width, radiance.height);
  for (std::size_t i = 0; i < sharp.values.size(); ++i)
    sharp.values[i] = (1 - imager.glare) * sharp.values[i] + imager.glare * wide.values[i];
  return sharp;
}

RawFrame exposed(const GreyImage& focused, const Imager& imager, double exposure_s, const ImagerSeeds& seeds) {
  RawFrame frame{focused.width, focused.height, exposure_s, std::vector<std::uint16_t>(focused.values.size())};
  const double gain_e = electrons_per_radiance(imager) * exposure_s, dark_e = imager.dark_eps * exposure_s;
  const int greatest = greatest_number(imager);
  std::size_t pixel = 0;
  for (int row = 0; row < focused.height; ++row) {
    sim::Random response = sim::ray_stream(seeds.camera, kResponse, static_cast<std::uint32_t>(row));
    sim::Random reading = sim::ray_stream(seeds.camera ^ (seeds.frame * 0x9E3779B97F4A7C15U), kReading, static_cast<std::uint32_t>(row));
    for (int column = 0; column < focused.width; ++column, ++pixel) {
      const double light_e = focused.values[pixel] * gain_e * (1 + imager.prnu * response.gaussian());
      const double mean_e = std::max(0.0, light_e) + dark_e;
      const double signal_e = std::min(imager.full_well_e, shot_noise(std::min(mean_e, 4 * imager.full_well_e), reading));
      const double read_e = signal_e + imager.read_noise_e * reading.gaussian();
      frame.numbers[pixel] =
          static_cast<std::uint16_t>(std::clamp(std::floor(read_e * greatest / imager.full_well_e + 0.5), 0.0, double(greatest)));
    }
  }
  return frame;
}

std::vector<std::uint8_t> square_root_codes(const RawFrame& frame, int greatest) {
  std::vector<std::uint8_t> table;
  for (int number = 0; number <= greatest; ++number)
    table.push_back(static_cast<std::uint8_t>(std::floor(255 * std::sqrt(static_cast<double>(number) / greatest) + 0.5)));
  std::vector<std::uint8_t> codes;
  codes.reserve(frame.numbers.size());
  for (const std::uint16_t number : frame.numbers) codes.push_back(table.at(number));
  return codes;
}

}  // namespace lasso::mdat
