#include "mdat/availability/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lasso::mdat {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct Spread {
  double median = kNothing, rms = kNothing, worst = kNothing;
};

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value * value;
  return {values[(values.size() - 1) / 2], std::sqrt(sum / static_cast<double>(values.size())), values.back()};
}

}  // namespace

bool is_available(const FrameError& error) { return error.valid && !error.wrong; }

FrameFigures figures_of(const std::vector<SeenFrame>& frames) {
  FrameFigures figures;
  std::vector<double> mm, deg;
  double nees = 0;
  for (const SeenFrame& seen : frames) {
    const FrameError& error = seen.error;
    ++figures.frames;
    if (error.wrong) ++figures.wrong;
    if (!is_available(error)) continue;
    ++figures.available;
    mm.push_back(1e3 * error.registration.translation_m.norm());
    deg.push_back(error.registration.rotation_rad / kRadPerDeg);
    nees += error.nees;
  }
  const Spread position = spread_of(mm), attitude = spread_of(deg);
  figures.median_mm = position.median;
  figures.rms_mm = position.rms;
  figures.worst_mm = position.worst;
  figures.median_deg = attitude.median;
  figures.rms_deg = attitude.rms;
  figures.worst_deg = attitude.worst;
  figures.nees = mm.empty() ? kNothing : nees / static_cast<double>(mm.size());
  return figures;
}

FrameFigures figures_in(const std::vector<SeenFrame>& frames, LightPhase phase) {
  std::vector<SeenFrame> within;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(within),
               [&](const SeenFrame& seen) { return phase_of(seen.light) == phase; });
  return figures_of(within);
}

std::vector<SeenFrame> frames_of(const std::vector<OrbitSample>& samples) {
  std::vector<SeenFrame> frames;
  for (const OrbitSample& sample : samples) frames.push_back(sample.seen);
  return frames;
}

std::vector<SeenFrame> frames_at(const std::vector<OrbitSample>& samples, double beta_rad) {
  std::vector<SeenFrame> frames;
  for (const OrbitSample& sample : samples) {
    if (sample.beta_rad == beta_rad) frames.push_back(sample.seen);
  }
  return frames;
}

std::vector<double> betas_of(const std::vector<OrbitSample>& samples) {
  std::vector<double> betas;
  for (const OrbitSample& sample : samples) {
    if (std::find(betas.begin(), betas.end(), sample.beta_rad) == betas.end()) betas.push_back(sample.beta_rad);
  }
  return betas;
}

}  // namespace lasso::mdat
