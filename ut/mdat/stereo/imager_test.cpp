#include "mdat/stereo/imager.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "fsw/geometry/portable_math.hpp"
#include "ut/mdat/stereo/images.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr int kSide = 200;  // 40000 pixels: a spread is known to 0.4 %

// One electron a number, none of the noise.
Imager plain_imager() {
  Imager imager;
  imager.bits = 15;
  imager.full_well_e = 32767;
  imager.prnu = imager.read_noise_e = imager.dark_eps = 0;
  return imager;
}

// The exposure at which this radiance makes so many electrons.
double exposure_for(const Imager& imager, double radiance, double electrons) {
  return electrons / (radiance * electrons_per_radiance(imager));
}

RawFrame frame_of(const Imager& imager, double electrons, std::uint64_t frame = 1) {
  return exposed(even(kSide, kSide, 3.0), imager, exposure_for(imager, 3.0, electrons), {7, frame});
}

// A lens of f-number N at 0.8 shows 1 W/m2/sr as 0.8 pi/(4 N^2) W/m2; 5.5 um squared of it for a second are 4.6e-13 J at f/4.
TEST(Imager, ElectronsAreThoseOfTheIrradianceBehindTheLens) {
  VERIFIES("LASSO-STE-001~1");
  Imager imager;
  imager.f_number = 4;
  const double energy_J = 0.8 * 3.14159265358979 / 64 * 5.5e-6 * 5.5e-6;
  const double photon_J = 6.62607015e-34 * 299792458 / 650e-9;
  EXPECT_NEAR(electrons_per_radiance(imager) / (0.45 * energy_J / photon_J), 1, 0.005);
  imager.f_number = 8;
  EXPECT_NEAR(electrons_per_radiance(imager) / (0.45 * energy_J / photon_J), 0.25, 0.005);
}

TEST(Imager, ShotNoiseIsTheRootOfTheElectrons) {
  VERIFIES("LASSO-STE-001~1");
  for (const double electrons : {5.0, 40.0, 900.0, 12000.0}) {
    const Spread spread = spread_of(frame_of(plain_imager(), electrons).numbers);
    EXPECT_NEAR(spread.mean / electrons, 1, 0.01) << electrons;
    EXPECT_NEAR(spread.sigma / std::sqrt(electrons), 1, 0.05) << electrons;
  }
}

TEST(Imager, ReadNoiseAddsInSquares) {
  VERIFIES("LASSO-STE-001~1");
  Imager imager = plain_imager();
  imager.read_noise_e = 8;
  const Spread spread = spread_of(frame_of(imager, 400).numbers);
  EXPECT_NEAR(spread.sigma / std::sqrt(400 + 64), 1, 0.05);
}

TEST(Imager, ResponseOfPixelsStaysFromFrameToFrame) {
  VERIFIES("LASSO-STE-001~1");
  Imager imager = plain_imager();
  imager.prnu = 0.05;  // 1000 electrons at 20000, where shot noise is 141
  const RawFrame one = frame_of(imager, 20000, 1), other = frame_of(imager, 20000, 2);
  std::vector<double> differences, means;
  for (std::size_t i = 0; i < one.numbers.size(); ++i) {
    differences.push_back(one.numbers[i] - other.numbers[i]);
    means.push_back(0.5 * (one.numbers[i] + other.numbers[i]));
  }
  EXPECT_NEAR(spread_of(differences).sigma / std::sqrt(2 * 20000.0), 1, 0.05);
  EXPECT_NEAR(spread_of(means).sigma / std::sqrt(1000.0 * 1000 + 10000), 1, 0.05);
}

TEST(Imager, DarkCurrentGrowsWithTheExposure) {
  VERIFIES("LASSO-STE-001~1");
  Imager imager = plain_imager();
  imager.dark_eps = 50;
  const RawFrame frame = exposed(even(kSide, kSide, 0), imager, 2, {1, 1});
  EXPECT_NEAR(spread_of(frame.numbers).mean, 100, 1);
  EXPECT_NEAR(spread_of(frame.numbers).sigma, 10, 0.5);
}

TEST(Imager, FullWellIsTheGreatestNumber) {
  VERIFIES("LASSO-STE-001~1");
  Imager imager;
  imager.read_noise_e = 0;
  const RawFrame over = frame_of(imager, 3 * imager.full_well_e), half = frame_of(imager, imager.full_well_e / 2);
  EXPECT_EQ(*std::min_element(over.numbers.begin(), over.numbers.end()), 4095);
  EXPECT_NEAR(spread_of(half.numbers).mean, 4095 / 2.0, 3);
}

TEST(Imager, LensSpreadsAPointByItsTwoKernels) {
  VERIFIES("LASSO-STE-001~1");
  Imager imager;
  imager.psf_px = 0.8;
  imager.glare = 0.05;
  imager.glare_px = 20;
  GreyImage point = even(400, 400, 0);
  point.values[200 * 400 + 203] = 1000;
  const GreyImage seen = through_lens(point, imager);
  double sum = 0, near = 0, second = 0, far_second = 0;
  for (int row = 0; row < 400; ++row) {
    for (int column = 0; column < 400; ++column) {
      const double value = seen.values[static_cast<std::size_t>(row * 400 + column)];
      const bool is_near = std::abs(row - 200) <= 4 && std::abs(column - 203) <= 4;
      sum += value;
      near += is_near ? value : 0;
      second += (is_near ? value : 0) * (column - 203) * (column - 203);
      far_second += (is_near ? 0 : value) * (row - 200) * (row - 200);
    }
  }
  EXPECT_NEAR(sum, 1000, 0.5);
  EXPECT_NEAR(near / 1000, 0.95, 0.005);
  EXPECT_NEAR(std::sqrt(second / near) / 0.8, 1, 0.05);
  EXPECT_NEAR(std::sqrt(far_second / 50) / 20, 1, 0.05);
}

TEST(Imager, SquareRootCodesHaveTheSameShotNoiseAtAnyBrightness) {
  VERIFIES("LASSO-STE-001~1");
  Imager imager;
  imager.read_noise_e = imager.prnu = 0;
  for (const double electrons : {2000.0, 14000.0}) {
    const std::vector<std::uint8_t> codes = square_root_codes(frame_of(imager, electrons), 4095);
    EXPECT_NEAR(spread_of(codes).mean, 255 * std::sqrt(electrons / 20000), 0.2);
    // d code / d e = 255 / (2 sqrt(20000 e)), and the steps of numbers and codes
    EXPECT_NEAR(spread_of(codes).sigma / std::sqrt(255 * 255 / (4 * 20000.0) + 1 / 12.0), 1, 0.05);
  }
}

TEST(Imager, FramesDependOnTheirSeedsAlone) {
  VERIFIES("LASSO-STE-002~1");
  const Imager imager;
  EXPECT_EQ(frame_of(imager, 500, 3).numbers, frame_of(imager, 500, 3).numbers);
  EXPECT_NE(frame_of(imager, 500, 3).numbers, frame_of(imager, 500, 4).numbers);
}

}  // namespace
}  // namespace lasso::mdat
