// Light at the detector: 10^5 drawn samples against the equations of the detector's contract, and those against other derivations.
#include "hal_sim/detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

constexpr std::uint32_t kSamples = 100000;

DetectorModel pulsed() {
  DetectorModel model;
  model.reference_electrons = 4000;
  model.reference_range_m = 50;
  model.reference_reflectance = 0.8;
  model.noise_electrons = 60;
  model.threshold_electrons = 240;
  model.width_m = 0.3;
  return model;
}

class Sun final : public SunSource {
 public:
  Sunlight at(TimeUs) const override { return {Vec3::UnitX(), 1}; }
};

double share_of(const DetectorModel& model, const Echoes& echoes, double background, RayState state) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    count += detect(model, echoes, background, draw_detector(3, i / 1000, i % 1000)).state == state ? 1U : 0U;
  }
  return static_cast<double>(count) / kSamples;
}

Echoes one(double electrons) {
  Echoes echoes;
  echoes.add({40, 40, electrons});
  return echoes;
}

TEST(Detector, TheSignalFallsWithTheSquareOfTheRange) {
  VERIFIES("LASSO-SIM-062~1");
  const DetectorModel model = pulsed();
  EXPECT_NEAR(signal_electrons(model, 0.8, 50), 4000, 1e-9);
  EXPECT_NEAR(signal_electrons(model, 0.2, 100), 250, 1e-9);
}

TEST(Detector, TheShareOfReturnsIsThatOfItsEquation) {
  VERIFIES("LASSO-SIM-062~1 LASSO-SIM-063~1");
  const DetectorModel model = pulsed();
  for (const double background : {0.0, 2500.0}) {
    for (const double electrons : {120.0, 240.0, 300.0, 420.0}) {
      const double expected = 0.5 * std::erfc((240 - electrons) / std::sqrt(2 * (electrons + background + 3600)));
      EXPECT_NEAR(return_probability(model, electrons, background), expected, 1e-12);
      EXPECT_NEAR(share_of(model, one(electrons), background, RayState::kHit), expected, 0.05 * expected);
    }
  }
}

TEST(Detector, AStrongReturnSaturates) {
  VERIFIES("LASSO-SIM-063~1");
  DetectorModel model = pulsed();
  model.saturation_electrons = 50000;
  EXPECT_EQ(detect(model, one(49000), 0, {}).state, RayState::kHit);
  EXPECT_EQ(detect(model, one(51000), 0, {}).state, RayState::kInvalid);
  EXPECT_EQ(detect(model, one(49000), 2000, {}).state, RayState::kInvalid);  // sunlight fills it as well
  EXPECT_NEAR(share_of(model, one(50000), 0, RayState::kInvalid), 0.5, 0.025);
}

// The centre of a pulse of n electrons whose times are drawn one by one.
TEST(Detector, ThePlaceOfAPulseIsAsUncertainAsItsElectronsSay) {
  VERIFIES("LASSO-SIM-062~1");
  DetectorModel model = pulsed();
  model.noise_electrons = 0;
  constexpr int kElectrons = 25;
  double sum2 = 0;
  constexpr int kPulses = 8000;
  for (int pulse = 0; pulse < kPulses; ++pulse) {
    double center_m = 0;
    for (std::uint32_t i = 0; i < kElectrons; ++i)
      center_m += 0.3 * draw_detector(9, static_cast<std::uint32_t>(pulse), i).counts[0] / kElectrons;
    sum2 += center_m * center_m;
  }
  EXPECT_NEAR(detector_sigma_m(model, {40, 40, kElectrons}, 0), std::sqrt(sum2 / kPulses), 0.05 * std::sqrt(sum2 / kPulses));
}

TEST(Detector, ASpotWidensWithTheSquareOfTheDepth) {
  VERIFIES("LASSO-SIM-062~1");
  DetectorModel model = pulsed();
  model.width_k_per_m = 1e-3;
  EXPECT_NEAR(width_m(model, 20), std::hypot(0.3, 0.4), 1e-12);
}

TEST(Detector, SurfacesApartAreToldByTheSensorsRule) {
  VERIFIES("LASSO-SIM-065~1");
  DetectorModel model = pulsed();
  Echoes echoes;
  echoes.add({42, 42, 900});
  echoes.add({40, 40, 1800});
  const auto told_m = [&](Returns returns) {
    model.returns = returns;
    return detect(model, echoes, 0, {}).echo.range_m;
  };
  EXPECT_EQ(told_m(Returns::kFirst), 40);
  EXPECT_EQ(told_m(Returns::kLast), 42);
  EXPECT_EQ(told_m(Returns::kStrongest), 40);
  EXPECT_NEAR(told_m(Returns::kMixed), 40 + 2.0 / 3, 1e-9);
  echoes[1].electrons = 100;  // below the threshold
  EXPECT_EQ(told_m(Returns::kFirst), 42);
  echoes[1] = {41.5, 41.5, 900};  // nearer than 2.35 pulses of 0.3 m
  EXPECT_NEAR(told_m(Returns::kFirst), 41.75, 1e-9);
}

TEST(Detector, FalseAlarmsAreAsManyAsTheirEquationSays) {
  VERIFIES("LASSO-SIM-064~1");
  const DetectorModel model = pulsed();
  const FalseAlarms alarms(model, 1, 100);
  const double expected = 99 / 0.3 * std::exp(-0.5 * 16) / (2 * std::sqrt(2.0) * M_PI);
  EXPECT_NEAR(alarms.mean(0), expected, 1e-6 * expected);
  const double background = 4000;  // N^2 = 7600
  const double more = 99 / 0.3 * std::exp(-0.5 * 240 * 240 / 7600.0) / (2 * std::sqrt(2.0) * M_PI);
  int count = 0;
  double sum_m = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const double range_m = alarms.range_m(background, draw_detector(4, i / 1000, i % 1000));
    count += range_m > 0 ? 1 : 0;
    sum_m += range_m > 0 ? range_m : 0;
  }
  const double share = 1 - std::exp(-more);
  EXPECT_NEAR(count, kSamples * share, 0.05 * kSamples * share);
  EXPECT_NEAR(sum_m / count, 50.5 - 99 * more / 12, 1);  // the first of several is nearer than the middle
}

// A filtered noise, made sample by sample, crosses the threshold as often as Rice's equation says.
TEST(Detector, FilteredNoiseCrossesTheThresholdAsOftenAsTheEquationSays) {
  VERIFIES("LASSO-SIM-064~1");
  constexpr int kHalf = 24, kTotal = 400000;  // samples of 1/6 of the pulse's width
  constexpr double kStep = 1.0 / 6, kLevel = 1.5;
  std::vector<double> kernel, white;
  double square = 0;
  for (int i = -kHalf; i <= kHalf; ++i) {
    kernel.push_back(std::exp(-0.5 * i * i * kStep * kStep));
    square += kernel.back() * kernel.back();
  }
  for (std::uint32_t i = 0; i < kTotal; ++i) white.push_back(draw_detector(8, i / 1000, i % 1000).counts[1]);
  int crossings = 0;
  double before = 0;
  for (std::size_t i = 0; i + kernel.size() < white.size(); ++i) {
    double value = 0;
    for (std::size_t k = 0; k < kernel.size(); ++k) value += kernel[k] * white[i + k];
    value /= std::sqrt(square);
    crossings += before <= kLevel && value > kLevel ? 1 : 0;
    before = value;
  }
  DetectorModel model = pulsed();
  model.width_m = 1;
  model.noise_electrons = 1;
  model.threshold_electrons = kLevel;
  const double widths = kTotal * kStep;
  EXPECT_NEAR(FalseAlarms(model, 1, 1 + widths).mean(0), crossings, 0.05 * crossings);
}

// By powers and areas instead of the reference return.
TEST(Detector, SunlightIsWhatThroughTheAperturePasses) {
  VERIFIES("LASSO-SIM-066~1");
  constexpr double kAperture_m2 = 5e-4, kEfficiency = 0.4, kPhoton_J = 6.62607015e-34 * 299792458 / 1550e-9;
  DetectorModel model = pulsed();
  model.energy_J = 2e-6;
  model.bandpass_m = 10e-9;
  model.field_rad = 0.5e-3;
  model.gate_s = 5e-9;
  model.reference_electrons = model.energy_J * 0.8 / M_PI * kAperture_m2 / (50.0 * 50.0) * kEfficiency / kPhoton_J;
  const double radiance = 0.7 / M_PI;  // of a white surface, 1/sr
  const double power_W = 0.27 * 10 * radiance * M_PI * 0.25e-6 * kAperture_m2;
  const double expected = power_W * 5e-9 * kEfficiency / kPhoton_J;
  EXPECT_NEAR(sun_electrons(model, radiance), expected, 1e-9 * expected);
}

TEST(Detector, TheSunItselfIsSeenWithinTheFieldAlone) {
  VERIFIES("LASSO-SIM-066~1");
  DetectorModel model = pulsed();
  model.field_rad = 2e-3;
  model.glare_per_sr = 1e-6;
  EXPECT_NEAR(glare_radiance_per_sr(model, std::cos(0.1)), 1e-6 / std::pow(std::sin(0.1), 2), 1e-12);
  const double disc_sr = 2 * M_PI * (1 - std::cos(4.6505e-3));
  EXPECT_NEAR(glare_radiance_per_sr(model, 1), 1 / disc_sr, 0.01 / disc_sr);
  EXPECT_EQ(glare_radiance_per_sr(model, -0.5), 0);
}

TEST(Detector, ValuesOutsideTheirRangeAreNamed) {
  VERIFIES("LASSO-SIM-062~1");
  EXPECT_NO_THROW(validate(DetectorModel{}));
  DetectorModel model = pulsed();
  model.reference_reflectance = 0;
  EXPECT_THROW(validate(model), std::invalid_argument);
  model = pulsed();
  model.bandpass_m = 1e-8;  // of a laser without energy
  EXPECT_THROW(validate(model), std::invalid_argument);
  EXPECT_FALSE(has_sunlight(model));
  model.sun = std::make_shared<Sun>();
  EXPECT_TRUE(has_sunlight(model));
}

}  // namespace
}  // namespace lasso::sim
