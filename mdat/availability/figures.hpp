// What is said of many frames: how many have a pose, and how good it is.
#pragma once

#include <functional>
#include <vector>

#include "mdat/availability/comparison.hpp"
#include "mdat/common/limits.hpp"

namespace lasso::mdat {

constexpr double kAvailabilityConfidence = 0.95;
// The 2005 paper on camera systems, as this project's issues have it: they serve for 80 % of an orbit. What it counts is not known here.
constexpr double kPaperCameraAvailability = 0.8;

// A pose is available where it says that it is valid, and is not wrong (mdat/run/verdict.hpp). Errors are those of available poses of
// single scans; NaN where there is none.
struct FrameFigures {
  std::size_t frames = 0, available = 0, wrong = 0;
  double median_mm = 0, rms_mm = 0, worst_mm = 0;
  double median_deg = 0, rms_deg = 0, worst_deg = 0;
  double nees = 0;  // mean; 6 where covariances are honest

  double share() const { return frames == 0 ? 0 : static_cast<double>(available) / static_cast<double>(frames); }
  Limits limits() const { return share_limits(static_cast<double>(available), static_cast<double>(frames), kAvailabilityConfidence); }
};

bool is_available(const FrameError& error);

FrameFigures figures_of(const std::vector<SeenFrame>& frames);
// Of those of one phase.
FrameFigures figures_in(const std::vector<SeenFrame>& frames, LightPhase phase);

std::vector<SeenFrame> frames_of(const std::vector<OrbitSample>& samples);
// Of the orbits of one elevation of the Sun.
std::vector<SeenFrame> frames_at(const std::vector<OrbitSample>& samples, double beta_rad);
// In the order in which they were flown, each once.
std::vector<double> betas_of(const std::vector<OrbitSample>& samples);

}  // namespace lasso::mdat
