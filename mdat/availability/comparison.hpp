// Flies one approach, and samples of whole orbits, with each head: when there is a pose, and how good it is, by light.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mdat/availability/heads.hpp"
#include "mdat/availability/light_phase.hpp"

namespace lasso::mdat {

struct ComparisonOptions {
  HeadsMission mission;
  std::string approach = "approach";                // scenario that is flown as it stands
  std::string hold = "hold";                        // scenario of whose first frame the samples of orbits are
  std::optional<std::uint32_t> frames;              // of the approach; otherwise the scenario's
  std::vector<double> betas_deg = {0, 30, 60, 75};  // the Sun's elevations above the orbit planes
  std::uint32_t angles = 12;                        // evenly spread places of each orbit; 0: no orbits
  unsigned jobs = 1;                                // threads; no effect on the results
};

struct SeenFrame {
  FrameError error;
  LightAt light;
};

// One light of an orbit, one view.
struct OrbitSample {
  double beta_rad = 0, angle_rad = 0;  // from orbit noon
  SeenFrame seen;
};

struct HeadResult {
  Head head;
  std::vector<SeenFrame> approach;
  std::vector<KeptScan> scans;  // of the approach, all
  std::vector<OrbitSample> orbits;
};

// What light changes in a laser's telemetry: one view in the light of each sample.
enum class LaserInLight : std::uint8_t {
  kSameBits = 0,     // nothing
  kOtherBits = 1,    // something: the mission has the Sun in the detector
  kOtherMotion = 2,  // the target, too, moves with the Sun: nothing can be compared
  kNotCompared = 3,  // there were no two lights
};

struct HeadComparison {
  std::string mission, approach, hold, commit;
  double period_s = 0;  // of frames
  std::vector<HeadResult> heads;
  LaserInLight laser = LaserInLight::kNotCompared;
  double seconds = 0;
};

// Throws as input_of_head and run_case.
HeadComparison compare_heads(const ComparisonOptions& options);

}  // namespace lasso::mdat
