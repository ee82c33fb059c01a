// Tracks from rough starts: the target at a random angle of the paper's simulation at 4 m, the start off by up to 20 deg about a random
// axis and up to 0.3 m on each axis, the scanner's noise on. A start counts as found when the seventh reported pose is within 10 mm and 0.5
// deg.
//
// usage: basin MISSION [STARTS = 1000] [SEED = 1]
#include <algorithm>
#include <cstdio>
#include <memory>

#include "ft/campaign/draws.hpp"
#include "ft/campaign/verdict.hpp"
#include "mdat/common/count.hpp"
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
    campaign::begin(*component_, mdat::view(memory_, image_.size()));
  }

  // The last pose that the component reports for this start.
  PoseTelemetry run(const Pose& truth, const Pose& start) {
    still_.pose = truth;
    campaign::start_tracking(*component_, start);
    PoseTelemetry last;
    for (int frame = 0; frame < kReports + kPipelineFrames; ++frame) {
      const std::vector<std::uint8_t> telemetry = campaign::run_frame(*component_);
      const campaign::Decoded decoded = campaign::decode(ConstBytes(telemetry.data(), telemetry.size()));
      if (!decoded.poses.empty()) last = decoded.poses.back();
    }
    return last;
  }

 private:
  static MissionParameters with_rough_start(MissionParameters parameters) {
    parameters.initial_present = 0;
    parameters.start_sigma_rad = kRotation_rad;
    parameters.start_sigma_m = kShift_m;
    parameters.start_check = 0;  // what the registration finds, not when it is believed
    return parameters;
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
  int wrong = 0;  // though called valid
  double worst_m = 0, worst_rad = 0;
};

void judge(const PoseTelemetry& report, const Pose& truth, Tally& tally) {
  if (campaign::judge_valid(report, truth) == campaign::PoseVerdict::kWrong) ++tally.wrong;
  const Vec6 error = pose_difference(mdat::registration_pose(report), truth);
  const double shift = error.tail<3>().norm();
  const double turn = error.head<3>().norm();
  if (report.valid == 0 || !(shift < kFound_m && turn < kFound_rad)) return;
  ++tally.found;
  tally.worst_m = std::max(tally.worst_m, shift);
  tally.worst_rad = std::max(tally.worst_rad, turn);
}

int run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: basin MISSION [STARTS = 1000] [SEED = 1]\n");
    return 2;
  }
  const int starts = argc > 2 ? mdat::count_of<int>("STARTS", argv[2], 1) : 1000;
  const std::uint64_t seed = argc > 3 ? mdat::count_of<std::uint64_t>("SEED", argv[3]) : 1;
  const mdat::CompiledMission mission = mdat::compile_mission(argv[1]);
  const mdat::Scenario& scenario = mdat::scenario_of(mission.source, "paper");
  const auto trajectory = mdat::make_trajectory(scenario, kRange_m, mdat::kEpochUs, 200000);
  Trial trial(mission, seed);
  sim::Random random(seed);
  Tally tally;
  for (int i = 0; i < starts; ++i) {
    const auto frame = static_cast<TimeUs>(random.uniform() * 360);
    const Pose truth = trajectory->at(mdat::kEpochUs + frame * 200000).T_sensor_target;
    judge(trial.run(truth, campaign::disturbed(truth, kRotation_rad, kShift_m, random)), truth, tally);
    if ((i + 1) % (starts / 10 + 1) == 0) std::fprintf(stderr, "%d of %d starts\n", i + 1, starts);
  }
  std::printf("starts found: %d of %d (%.1f %%); of these the worst is %.2f mm, %.3f deg off; wrong but valid: %d\n", tally.found, starts,
              100.0 * tally.found / starts, 1e3 * tally.worst_m, tally.worst_rad / kRadPerDeg, tally.wrong);
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
