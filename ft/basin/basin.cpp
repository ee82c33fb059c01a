// Tracks from rough starts: the target at a random angle of the paper's simulation at 4 m, the start off by up to 20 deg about a random
// axis and up to 0.3 m on each axis, the scanner's noise on. A start counts as found when the seventh reported pose is within 10 mm and 0.5
// deg.
//
// usage: basin MISSION [STARTS = 1000] [SEED = 1]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "fsw/exec/lasso.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace {

using namespace lasso;

constexpr double kRotation_rad = 20 * kRadPerDeg;
constexpr double kShift_m = 0.3;
constexpr double kFound_m = 0.010;
constexpr double kFound_rad = 0.5 * kRadPerDeg;
constexpr double kRange_m = 4;
constexpr int kReports = 7;
constexpr int kPipelineFrames = 3;

// A target that stands still where the next start wants it.
class StillTarget final : public sim::Trajectory {
 public:
  sim::TruthState at(TimeUs) const override { return {pose, {}}; }
  Pose pose;
};

Vec3 draw_in_box(sim::Random& random) { return {random.uniform() * 2 - 1, random.uniform() * 2 - 1, random.uniform() * 2 - 1}; }

Vec3 draw_direction(sim::Random& random) {
  for (;;) {
    const Vec3 v = draw_in_box(random);
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

Pose disturbed(const Pose& truth, sim::Random& random) {
  Pose start;
  const double angle = (random.uniform() * 2 - 1) * kRotation_rad;
  start.q = exp_so3(angle * draw_direction(random)) * truth.q;
  start.p = truth.p + kShift_m * draw_in_box(random);
  return start;
}

class Trial {
 public:
  explicit Trial(const mdat::CompiledMission& mission, std::uint64_t seed)
      : scenario_(mdat::scenario_of(mission.source, "paper")),
        parameters_(mdat::parameters_for(mission.source, "paper")),
        image_(mdat::image_bytes(mission, with_rough_start(parameters_))),
        memory_(mdat::aligned_copy(image_)),
        target_(mdat::make_target(mission.mesh)),
        scanner_(*target_, still_, mdat::scanner_model(scenario_, parameters_, true), seed),
        component_(std::make_unique<Component>(scanner_)) {
    const LoadFailure failure = component_->load_image(mdat::view(memory_, image_.size()));
    if (failure.status != Status::kOk) throw mdat::RunError(mdat::to_string(failure));
    if (component_->begin(mdat::kEpochUs) != Status::kOk) throw mdat::RunError("the component does not begin");
  }

  // The last pose that the component reports for this start.
  PoseTelemetry run(const Pose& truth, const Pose& start) {
    still_.pose = truth;
    if (component_->start_tracking(start, {}, component_->next_slot_us()) != Status::kOk) throw mdat::RunError("a start is refused");
    PoseTelemetry last;
    for (int frame = 0; frame < kReports + kPipelineFrames; ++frame) run_frame(last);
    return last;
  }

 private:
  static MissionParameters with_rough_start(MissionParameters parameters) {
    parameters.initial_present = 0;
    parameters.start_sigma_rad = kRotation_rad;
    parameters.start_sigma_m = kShift_m;
    return parameters;
  }
  void run_frame(PoseTelemetry& last) {
    for (int slot = 0; slot < 20; ++slot) static_cast<void>(step(*component_, component_->next_slot_us()));
    std::uint8_t bytes[kTelemetryQueueBytes];
    const std::size_t size = component_->take_telemetry(Bytes(bytes));
    PacketHeader header;
    for (std::size_t at = 0; at < size; at += packet_size(ConstBytes(bytes + at, size - at))) {
      static_cast<void>(decode_pose(ConstBytes(bytes + at, packet_size(ConstBytes(bytes + at, size - at))), header, last));
    }
  }

  const mdat::Scenario& scenario_;
  MissionParameters parameters_;
  std::vector<std::uint8_t> image_;
  std::vector<std::uint64_t> memory_;
  std::unique_ptr<sim::RayCaster> target_;
  StillTarget still_;
  sim::SimulatedScanner scanner_;
  std::unique_ptr<Component> component_;
};

struct Tally {
  int found = 0;
  double worst_m = 0, worst_rad = 0;
};

void judge(const PoseTelemetry& report, const Pose& truth, Tally& tally) {
  const Vec6 error = pose_difference(mdat::registration_pose(report), truth);
  const double shift = error.tail<3>().norm();
  const double turn = error.head<3>().norm();
  if (report.valid == 0 || !(shift < kFound_m && turn < kFound_rad)) return;
  ++tally.found;
  tally.worst_m = std::max(tally.worst_m, shift);
  tally.worst_rad = std::max(tally.worst_rad, turn);
}

int run(int argc, char** argv) {
  const int starts = argc > 2 ? std::atoi(argv[2]) : 1000;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  if (argc < 2 || starts < 1) {
    std::fprintf(stderr, "usage: basin MISSION [STARTS = 1000] [SEED = 1]\n");
    return 2;
  }
  const mdat::CompiledMission mission = mdat::compile_mission(argv[1]);
  const mdat::Scenario& scenario = mdat::scenario_of(mission.source, "paper");
  const auto trajectory = mdat::make_trajectory(scenario, kRange_m, mdat::kEpochUs, 200000);
  Trial trial(mission, seed);
  sim::Random random(seed);
  Tally tally;
  for (int i = 0; i < starts; ++i) {
    const auto frame = static_cast<TimeUs>(random.uniform() * 360);
    const Pose truth = trajectory->at(mdat::kEpochUs + frame * 200000).T_sensor_target;
    judge(trial.run(truth, disturbed(truth, random)), truth, tally);
    if ((i + 1) % (starts / 10 + 1) == 0) std::fprintf(stderr, "%d of %d starts\n", i + 1, starts);
  }
  std::printf("starts found: %d of %d (%.1f %%); of these the worst is %.2f mm, %.3f deg off\n", tally.found, starts,
              100.0 * tally.found / starts, 1e3 * tally.worst_m, tally.worst_rad / kRadPerDeg);
  return tally.found >= 0.99 * starts ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "basin: %s\n", error.what());
    return 2;
  }
}
