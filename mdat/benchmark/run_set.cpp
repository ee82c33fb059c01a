#include "mdat/benchmark/run_set.hpp"

#include "mdat/common/flight_image.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/replay/replay.hpp"

namespace lasso::mdat {
namespace {

std::vector<ReplayedScan> replay_body(const std::filesystem::path& folder, bool cached) {
  ReplayOptions options;
  options.scans = folder / kScansFolder;
  options.initial = folder / kStartsFile;
  options.wide = true;
  ReplayInput input = read_replay_input(options);
  const CompiledMission mission = compile_mission(load_mission_input(folder / kMissionFile), ModelCache::of_user_if(cached));
  const LoadedImage image(mission.source.name, image_bytes(mission, mission.source.parameters));
  (void)settle_times(options, image.mission().parameters.duration_s, input);
  return replay(image.mission(), options, input);
}

ProgramPose row_of(const std::string& body, const ReplayedScan& scan) {
  const Registration& found = scan.registration;
  return {body, scan.scan, found.valid(), found.T_sensor_target, found.covariance, 1e-6 * scan.estimate_us};
}

}  // namespace

ProgramPoses run_set(const std::filesystem::path& folder, bool cached) {
  const Protocol protocol = read_protocol(folder);
  check_files(folder, protocol);
  ProgramPoses poses{"3dlasso", true, {}};
  ProgressBar bar("run", protocol.bodies.size(), "bodies", kQuietReplay_s);
  for (const ProtocolBody& body : protocol.bodies) {
    for (const ReplayedScan& scan : replay_body(folder / body.name, cached)) poses.rows.push_back(row_of(body.name, scan));
    bar.show(poses.rows.size() / protocol.plan.scans);
  }
  bar.finish();
  return poses;
}

}  // namespace lasso::mdat
