// What a scan of a mission would look like: its target where a scenario begins, and the pattern's rays on it.
#pragma once

#include <string>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "fsw/mission/parameters.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat::serve {

// A ray in the frame of the sensor that scans; one that meets nothing is stated at the range of the target's origin.
struct PreviewRay {
  Vec3 place_m = Vec3::Zero();
  double time_s = 0;  // after the first
  bool hit = false;
};

struct ScanPreview {
  std::string scenario, sensor;    // the one whose turn it is at this range
  std::vector<double> ranges_m;    // of the scenario's runs
  std::size_t run = 0;             // which of them is shown
  Pose T_sensor_target;            // true, at the begin of frame 0
  Pose T_sensor_own;               // where that sensor stands and looks: its own frame in the sensor frame
  MissionParameters parameters{};  // of the sensor in this scenario
  double size_m = 0;               // diameter of a sphere about the target's origin that holds it
  std::vector<PreviewRay> rays;    // of scan 0, the target at rest
  std::string remark;              // why there are no rays, or what they leave out; empty: nothing to say
};

// By the component's planner and pattern, on the target alone.
// `target` is load_target's, and the source's scene is loaded (load_scene). Throws MissionError: there is no such scenario.
ScanPreview preview_scan(const MissionSource& source, const Mesh& target, const std::string& scenario, std::size_t run);

}  // namespace lasso::mdat::serve
