#include "mdat/stereo/stereo_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lasso::mdat {
namespace {

constexpr double kDarkBelow = 0.4, kBrightFrom = 0.7;
constexpr std::size_t kEnough = 40;  // pixels, of which a share or a distribution is formed

// A pixel beside something nearer has the nearer one's disparity where that explains the measured one better.
bool is_spread(const PixelSight& sight, double measured_px) {
  const bool beside = sight.region == PixelRegion::kFarEdge || sight.region == PixelRegion::kHidden || sight.region == PixelRegion::kSky;
  return beside && std::fabs(measured_px - sight.nearer_px) < std::fabs(measured_px - sight.disparity_px);
}

// Each empty entry gets that of the nearest one with something.
template <class Entries, class HasSome>
void fill_gaps(Entries& entries, const HasSome& has_some) {
  const Entries known = entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t off = 0; off < entries.size(); ++off) {
      if (i >= off && has_some(i - off)) {
        entries[i] = known[i - off];
        break;
      }
      if (i + off < entries.size() && has_some(i + off)) {
        entries[i] = known[i + off];
        break;
      }
    }
  }
}

std::string number_list(const double* begin, std::size_t count) {
  std::string text = "{";
  for (std::size_t i = 0; i < count; ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.4g", i == 0 ? "" : ", ", begin[i]);
    text += number;
  }
  return text + "}";
}

}  // namespace

const std::array<double, kFitQuantiles> kFitShares = {0,   0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12, 0.2,   0.3,   0.4, 0.5,
                                                      0.6, 0.7,   0.8,   0.88, 0.92, 0.95, 0.97, 0.98, 0.99, 0.995, 0.998, 1};

std::size_t fit_level(double level) { return std::min(kFitLevels - 1, static_cast<std::size_t>(std::max(0.0, level) * kFitLevels)); }
std::size_t fit_group(double level) { return level < kDarkBelow ? 0 : level < kBrightFrom ? 1 : 2; }

void FitCounts::add(const PixelSight& sight, double measured_px) {
  if (sight.region == PixelRegion::kEmpty) return;
  Region& region = regions_[static_cast<std::size_t>(sight.region)];
  ++region.pixels[fit_level(sight.level)];
  if (measured_px <= 0) return;
  ++region.valid[fit_level(sight.level)];
  const bool spread = is_spread(sight, measured_px);
  if (spread) ++region.spread;
  region.errors_px[fit_group(sight.level)].push_back(measured_px - (spread ? sight.nearer_px : sight.disparity_px));
}

StereoFit FitCounts::fit() const {
  StereoFit fit;
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const Region& region = regions_[r];
    std::size_t valid = 0;
    for (std::size_t i = 0; i < kFitLevels; ++i) {
      valid += region.valid[i];
      fit[r].valid[i] = static_cast<double>(region.valid[i]) / static_cast<double>(std::max<std::size_t>(1, region.pixels[i]));
    }
    fit[r].spread = static_cast<double>(region.spread) / static_cast<double>(std::max<std::size_t>(1, valid));
    for (std::size_t g = 0; g < kFitGroups; ++g) {
      std::vector<double> errors = region.errors_px[g];
      std::sort(errors.begin(), errors.end());
      for (std::size_t q = 0; q < kFitQuantiles && !errors.empty(); ++q)
        fit[r].errors_px[g][q] = errors[static_cast<std::size_t>(std::lround(kFitShares[q] * static_cast<double>(errors.size() - 1)))];
    }
    fill_gaps(fit[r].valid, [&](std::size_t i) { return region.pixels[i] >= kEnough; });
    fill_gaps(fit[r].errors_px, [&](std::size_t g) { return region.errors_px[g].size() >= kEnough; });
  }
  return fit;
}

std::string fit_text(const StereoFit& fit) {
  std::string text;
  for (const RegionFit& region : fit) {
    char spread[32];
    std::snprintf(spread, sizeof spread, "%.4g", region.spread);
    text += "{" + number_list(region.valid.data(), kFitLevels) + ",\n " + spread + ",\n {{";
    for (std::size_t g = 0; g < kFitGroups; ++g) text += (g == 0 ? "" : ",\n   ") + number_list(region.errors_px[g].data(), kFitQuantiles);
    text += "}}},\n";
  }
  return text;
}

double fitted_error_px(const RegionFit& fit, double level, double share) {
  const auto& errors_px = fit.errors_px[fit_group(level)];
  const auto above = std::upper_bound(kFitShares.begin(), kFitShares.end(), share);
  const std::size_t high = std::clamp<std::size_t>(static_cast<std::size_t>(above - kFitShares.begin()), 1, kFitQuantiles - 1),
                    low = high - 1;
  const double part = std::clamp((share - kFitShares[low]) / (kFitShares[high] - kFitShares[low]), 0.0, 1.0);
  return errors_px[low] + part * (errors_px[high] - errors_px[low]);
}

}  // namespace lasso::mdat
