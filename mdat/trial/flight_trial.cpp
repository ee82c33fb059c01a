#include "mdat/trial/flight_trial.hpp"

#include <limits>

#include "mdat/common/errors.hpp"
#include "mdat/run/case_pool.hpp"
#include "mdat/run/simulation.hpp"
#include "mdat/stereo/stereo_maker.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint64_t kNextDraw = 1000003;  // between seeds of errors of one flight

// Which case of all a flight is.
struct FlightOf {
  std::size_t light = 0;
  std::uint32_t flight = 0, draw = 0;
  bool fitted = false;
};

class FlightTrial {
 public:
  FlightTrial(const CompiledMission& mission, const FlightTrialOptions& options)
      : mission_(mission),
        options_(options),
        scenario_(scenario_of(mission.source, options.scenario)),
        seed_(options.seed.value_or(static_cast<std::uint64_t>(scenario_.seed))),
        frames_(options.frames.value_or(static_cast<std::uint32_t>(scenario_.frames))),
        image_(image_bytes(mission, plain_case(mission.source, scenario_, 0, 0).parameters)),
        target_(simulated_target(mission.mesh, scenario_, seed_, mission.source.target_laser)) {
    for (const TrialLight& light : options.lights) {
      add_mission(light, false);
      add_mission(light, true);
    }
  }

  FlightTrialResult run() {
    add_cases();
    ProgressBar bar("track", cases_.size() * frames_, "frames");
    const std::vector<CaseResult> flown = run_cases(cases_, options_.jobs, bar);
    bar.finish();
    FlightTrialResult result{options_.scenario, frames_, options_.lights, {}, {}};
    for (std::size_t i = 0; i < flown.size(); ++i) {
      std::vector<TrialPose>& poses = flights_[i].fitted ? result.fitted : result.rendered;
      for (const FrameError& frame : flown[i].frames) {
        poses.push_back(flown_pose(frame));
        poses.back().light = flights_[i].light;
        poses.back().view = flights_[i].flight;
        poses.back().draw = flights_[i].draw;
      }
    }
    return result;
  }

 private:
  void add_mission(const TrialLight& light, bool fitted) {
    MissionInput lit{mission_.source, mission_.mesh};
    lit.source.stereo = lit_by(light, lit.source.stereo);
    lit.source.stereo.model = fitted ? 1 : 0;
    missions_.push_back(std::move(lit));
  }

  void add_cases() {
    for (std::size_t light = 0; light < options_.lights.size(); ++light) {
      for (std::uint32_t flight = 0; flight < options_.flights; ++flight) {
        if (options_.rendered) add_case({light, flight, 0, false});
        for (std::uint32_t draw = 0; draw < options_.draws; ++draw) add_case({light, flight, draw, true});
      }
    }
  }

  void add_case(const FlightOf& of) {
    const MissionInput& mission = missions_[2 * of.light + (of.fitted ? 1 : 0)];
    CaseSetup setup = plain_case(mission.source, scenario_, seed_ + of.flight, frames_);
    setup.seed += kNextDraw * of.draw;  // the motion is drawn already
    setup.image = &image_;
    setup.target = target_.get();
    setup.make_stereo = stereo_maker(mission, seed_, 1);
    setup.alone = true;
    cases_.push_back(std::move(setup));
    flights_.push_back(of);
  }

  const CompiledMission& mission_;
  const FlightTrialOptions& options_;
  Scenario scenario_;
  std::uint64_t seed_;
  std::uint32_t frames_;
  std::vector<std::uint8_t> image_;
  std::unique_ptr<sim::RayCaster> target_;
  std::vector<MissionInput> missions_;  // of each light, rendered and then fitted
  std::vector<CaseSetup> cases_;
  std::vector<FlightOf> flights_;  // of each case
};

void check_flights(const MissionSource& source, const std::string& scenario) {
  if (!has_stereo_head(source)) throw InputError(source.file.string() + ": has no stereo head to fly: sensor.kind = \"stereo\" makes one");
  if (scenario_of(source, scenario).runs_m().size() != 1)
    throw InputError("--flights: scenario " + scenario + " has several ranges: choose a scenario of one");
}

}  // namespace

TrialPose flown_pose(const FrameError& frame) {
  TrialPose pose;
  pose.scan = frame.frame;
  pose.reason = frame.valid || frame.reason != PoseReason::kValid ? frame.reason : PoseReason::kNoScan;
  pose.wrong = frame.wrong;
  pose.returns = frame.returns;
  pose.off_m = frame.registration.translation_m.norm();
  pose.off_rad = frame.registration.rotation_rad;
  pose.sigma_m = frame.sigma_m;
  pose.sigma_rad = frame.sigma_rad;
  pose.squared_position = pose.squared_attitude = std::numeric_limits<double>::quiet_NaN();
  pose.nees = frame.nees;
  return pose;
}

FlightTrialResult try_flights(const CompiledMission& mission, const FlightTrialOptions& options) {
  check_flights(mission.source, options.scenario);
  return FlightTrial(mission, options).run();
}

}  // namespace lasso::mdat
