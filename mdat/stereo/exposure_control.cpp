#include "mdat/stereo/exposure_control.hpp"

#include <algorithm>
#include <cmath>

namespace lasso::mdat {
namespace {

constexpr double kFirst_s = 1e-3;
constexpr double kSettled = 0.01;  // relative change
constexpr int kMostFrames = 16;
constexpr double kLitSigmas = 6, kLitShare = 0.005;

}  // namespace

double next_exposure_s(const RawFrame& frame, const Imager& imager) {
  const int greatest = greatest_number(imager);
  const double least = std::max(kLitShare, kLitSigmas * imager.read_noise_e / imager.full_well_e) * greatest;
  std::vector<std::size_t> counts(static_cast<std::size_t>(greatest) + 1, 0);
  std::size_t lit = 0;
  for (const std::uint16_t number : frame.numbers) {
    if (number <= least) continue;
    ++counts[number];
    ++lit;
  }
  double factor = kExposureJump;  // nothing is lit
  if (lit > 0) {
    const auto wanted = static_cast<std::size_t>(std::ceil(kMeteredShare * static_cast<double>(lit)));
    std::size_t darker = 0, number = 0;
    while (darker < wanted) darker += counts[number++];
    const auto level = static_cast<double>(number - 1) / greatest;
    factor = level < 1 ? kMeteredLevel / level : 1 / kExposureJump;
  }
  return std::clamp(frame.exposure_s * factor, kShortest_s, kLongest_s);
}

double saturated_share(const RawFrame& frame, const Imager& imager) {
  const auto count = std::count(frame.numbers.begin(), frame.numbers.end(), static_cast<std::uint16_t>(greatest_number(imager)));
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, frame.numbers.size()));
}

double settled_exposure_s(const GreyImage& focused, const Imager& imager, const ImagerSeeds& seeds) {
  double exposure_s = kFirst_s;
  for (int i = 0; i < kMostFrames; ++i) {
    const double next_s = next_exposure_s(exposed(focused, imager, exposure_s, seeds), imager);
    const bool settled = std::fabs(next_s - exposure_s) <= kSettled * exposure_s;
    exposure_s = next_s;
    if (settled) break;
  }
  return exposure_s;
}

}  // namespace lasso::mdat
