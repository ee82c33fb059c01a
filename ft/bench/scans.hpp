// The scans that every method of the benchmark registers: the simulated scanner's view of a mission's target, with the truth.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal_sim/ray_caster.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/bound.hpp"

namespace lasso::bench {

struct ScanOptions {
  std::string scenario = "paper";  // of the paper's kind
  std::uint32_t stride = 6;        // every stride-th frame of the scenario
  bool noise = true;
};

struct Scan {
  double range_m = 0;
  std::uint32_t frame = 0;
  std::vector<RangeSample> samples;
  Pose truth;  // T_sensor_target
  Pose start;  // the truth one frame before
  mdat::PoseBound bound;
};

// The scans of all ranges, planned from their starts. The same options give the same scans, and the same scans with and without noise.
// The peers know nothing of motion, so the target must stand still in each scan. Throws MissionError, InputError (the scenario is of
// another kind) or RunError.
std::vector<Scan> make_scans(const mdat::CompiledMission& mission, const ScanOptions& options);

// The flight image of the scenario, in memory. Throws as its parts.
std::unique_ptr<mdat::LoadedImage> make_image(const mdat::CompiledMission& mission, const std::string& scenario, bool silhouettes);

// Fills `image` with the scan, as the acquisition task would.
void to_range_image(const Scan& scan, RangeImage& image);

}  // namespace lasso::bench
