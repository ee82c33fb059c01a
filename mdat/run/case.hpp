// One closed-loop run: the simulated scanner, the flight component on its Linux board, and what its telemetry says against the truth.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fsw/link/authenticator.hpp"
#include "fsw/link/byte_link.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/sense/sensor.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_lcs/triangulation.hpp"
#include "hal_sim/lcs_faults.hpp"
#include "hal_sim/ray_caster.hpp"
#include "hal_sim/replay_sensor.hpp"
#include "hal_sim/scanner.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/run/command_stream.hpp"
#include "mdat/run/run_listener.hpp"
#include "mdat/run/simulated_scenario.hpp"
#include "mdat/run/statistics.hpp"
#include "mdat/run/taken_pair.hpp"
#include "mdat/run/timeline.hpp"

namespace lasso::mdat {

struct CaseSetup;

// A simulated sensor that is made of more than rays: it knows pictures, and the flight of a case does not.
class MadeSensor {
 public:
  virtual ~MadeSensor() = default;
  virtual Sensor& sensor() = 0;
  // Why it gives nothing more, in one line; empty: it works. The component's threads take no exception.
  virtual std::string failure() const = 0;
  // The pairs that its scans since the last call were made of, in their order; of any thread.
  virtual std::vector<TakenPair> take_pairs() { return {}; }
};
// Of the mission's stereo head, for a case, with noise by a seed.
using MakeStereo = std::function<std::unique_ptr<MadeSensor>(const CaseSetup&, std::uint64_t)>;

// What is chosen for a run besides its mission, from the command line down to each case.
struct CaseOptions {
  std::optional<lcs::Device> wire;                        // the heads that are reached over their lines (wired)
  std::shared_ptr<const sim::SensorRecording> replay;     // which the sensors play, instead of looking at the target
  std::string camera_line;                                // of this machine, over which it is reached, in real time; empty: simulated
  bool remote_line = false;                               // which may lead to other machines
  std::optional<TriangulationCalibration> camera_optics;  // of the simulated camera; otherwise the mission's calibrations, or the design's
  double camera_degC = 20;
  sim::LcsFaults camera_faults;  // of each that is; times since frame 0
  MakeStereo make_stereo;        // of sensors of this kind, where there is noise; empty: a mission that has one is refused
  ByteLink* link = nullptr;      // an operator's; the run then keeps the clock's pace, and nobody else starts a track that is lost
  std::shared_ptr<const CommandStream> commands;  // those of an earlier run, instead of a link: given again, as fast as it goes
  std::uint16_t apid = kApid;                     // of the component
  Authenticator* authenticator = nullptr;         // of the link's commands and images; null: they need none
  std::string store;  // folder of the board's store, whose image takes the place of the mission's if there is one; empty: none
};

struct CaseSetup : CaseOptions {
  Scenario scenario;
  double range_m = 0;
  bool noise = true;  // of the simulated scanner
  std::uint64_t seed = 1;
  std::uint32_t frames = 0;
  MissionParameters parameters{};  // as compiled into the image
  std::vector<FurtherSensor> further_sensors;
  std::shared_ptr<sim::SensorRecording> record;  // gets what the sensors give
  Calibrations calibrations;                     // of the mission
  SensorKind sensor = SensorKind::kLaserCamera;
  sim::FlashModel flash;  // kFlashLidar
  const std::vector<std::uint8_t>* image = nullptr;
  const sim::RayCaster* target = nullptr;
  sim::OtherBodies others;  // what a scene has beside the target
  RunListener* listener = nullptr;
  std::vector<std::uint32_t> keep_frames;  // whose scans the result holds; ascending
  bool alone = false;                      // simulated on the caller's thread: other cases fill the other cores; the same bytes

  void choose(const CaseOptions& options) { static_cast<CaseOptions&>(*this) = options; }
};

// A scan with all that a picture of it needs.
struct KeptScan {
  std::uint32_t frame = 0;
  Pose truth;  // at the scan's time
  PoseTelemetry telemetry;
  std::vector<RangeSample> samples;
  std::size_t aimed = 0;  // samples in the middle whose rays left the pattern
};

constexpr std::size_t kDoubtfulScans = 3;

struct CaseResult {
  std::vector<FrameError> frames;
  std::uint32_t flown = 0;              // frames: fewer than asked for where Ctrl-C ended them
  double end_s = 0;                     // of the last frame, since frame 0
  std::vector<std::uint8_t> telemetry;  // all packets, in order
  std::vector<KeptScan> scans;
  std::vector<KeptScan> doubtful;            // the first kDoubtfulScans whose valid poses are wrong, and as many without a valid pose
  Timeline timeline;                         // of a scenario that is shown along its time
  std::optional<std::uint32_t> found_frame;  // of the first valid pose
  std::uint32_t replay_rounds = 0;           // how often a recording that was at its end began anew, at most
  std::uint32_t replay_unserved = 0;         // scans that were asked for, and are not in it
};

// An autonomous flight begins in the mode `bearing`, with a navigation system's offers as the only help. A run without a prior begins
// there, too, and leaves out the frames before the first valid pose. Every other run starts the track from the true pose of one frame
// before the first, at rest. All that the result says of the estimates was decoded from telemetry packets. A track that the component gives
// up is then started again from the true pose of the frame before (its frames count as lost). Counts each frame in `done`. Throws RunError
// where the component refuses its image or a start.
CaseResult run_case(const CaseSetup& setup, std::atomic<std::size_t>& done);

Pose registration_pose(const PoseTelemetry& telemetry);
Pose filtered_pose(const PoseTelemetry& telemetry);
Mat6 registration_covariance(const PoseTelemetry& telemetry);

}  // namespace lasso::mdat
