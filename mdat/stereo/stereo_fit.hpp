// What a matcher makes of pixels, measured in rendered pairs: how often it finds a disparity, and how far that is off.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mdat/stereo/pair_sight.hpp"

namespace lasso::mdat {

constexpr std::size_t kFitLevels = 12;     // bins of PixelSight::level, evenly from 0 to 1
constexpr std::size_t kFitGroups = 3;      // of brightness for errors: dark, middle, bright
constexpr std::size_t kFitQuantiles = 25;  // of errors, at kFitShares
extern const std::array<double, kFitQuantiles> kFitShares;

std::size_t fit_level(double level);  // bin
std::size_t fit_group(double level);

// Of one region.
struct RegionFit {
  std::array<double, kFitLevels> valid{};                                 // share of pixels with a disparity
  double spread = 0;                                                      // of these, the share that has the nearer surface's
  std::array<std::array<double, kFitQuantiles>, kFitGroups> errors_px{};  // measured minus true, or minus the nearer surface's
};
using StereoFit = std::array<RegionFit, kPixelRegions>;

// Of the preset head by `mdat stereo --fit` (docs/stereo.md says of which views and lights).
const StereoFit& preset_fit();

// Pixels of rendered pairs, gathered.
class FitCounts {
 public:
  // `measured_px`: 0 where the matcher has nothing.
  void add(const PixelSight& sight, double measured_px);
  // Bins without pixels have the value of the nearest that has some.
  StereoFit fit() const;

 private:
  struct Region {
    std::array<std::size_t, kFitLevels> pixels{}, valid{};
    std::size_t spread = 0;
    std::array<std::vector<double>, kFitGroups> errors_px;
  };
  std::array<Region, kPixelRegions> regions_;
};

// As stereo_fit_preset.cpp holds it.
std::string fit_text(const StereoFit& fit);

// The error at a share of the distribution, 0 to 1.
double fitted_error_px(const RegionFit& fit, double level, double share);

}  // namespace lasso::mdat
