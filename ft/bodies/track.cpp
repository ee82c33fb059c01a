#include <atomic>
#include <cmath>
#include <numeric>

#include "ft/bodies/trials.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/text.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::bodies {
namespace {

constexpr double kFastest_radps = 4 * kRadPerDeg;
constexpr double kFarthest = 2;   // times the nearest range
constexpr double kDrift = 0.001;  // of the range, a second

// The scenario `spin` of the mission with the flight's range and spin; attitude and axes are drawn by the flight's seed.
mdat::Scenario flight_of(const Subject& subject, sim::Random& random) {
  mdat::Scenario scenario = mdat::scenario_of(subject.mission.source, "spin");
  const double range_m = subject.nearest_m * random.uniform(1, kFarthest);
  scenario.ranges_m = {range_m};
  scenario.spin_radps = {random.uniform(0, kFastest_radps), 0, 0};
  scenario.drift_mps = {kDrift * range_m, 0, 0};
  scenario.drawn = 1;
  return scenario;
}

// The command that flies it again, bit for bit, with a report.
std::string again_text(const Subject& subject, const mdat::Scenario& scenario, std::uint64_t seed, std::uint32_t frames) {
  std::string text = mdat::format(
      "mdat run %s --scenario spin --seed %llu --frames %u --set 'scenario.spin.ranges_m=[%.17g]' --set "
      "'scenario.spin.spin_degps=[%.17g,0,0]' --set 'scenario.spin.drift_mps=[%.17g,0,0]' --set scenario.spin.drawn=true",
      subject.mission.source.file.c_str(), static_cast<unsigned long long>(seed), frames, scenario.ranges_m.front(),
      scenario.spin_radps.front() / kRadPerDeg, scenario.drift_mps.front());
  for (const std::string& setting : subject.mission.source.settings) text += " --set '" + setting + "'";
  return text;
}

const mdat::KeptScan* kept_of(const mdat::CaseResult& result, std::uint32_t frame) {
  for (const mdat::KeptScan& scan : result.scans) {
    if (scan.frame == frame) return &scan;
  }
  return nullptr;
}

// A frame without a registration is as determined as the one before it.
void judge(const Subject& subject, std::size_t number, const mdat::CaseResult& result, Tally& tally) {
  Trial trial;
  trial.number = number;
  trial.settled = false;
  std::vector<mdat::JudgedFrame> flight;
  for (const mdat::FrameError& frame : result.frames) {
    const mdat::KeptScan* scan = kept_of(result, frame.frame);
    trial.frame = frame.frame;
    trial.range_m = frame.range_m;
    trial.valid = scan != nullptr && frame.valid;
    trial.reason = to_string(frame.reason);
    trial.sigma_m = frame.sigma_m;
    trial.sigma_rad = frame.sigma_rad;
    trial.level = frame.level;
    if (scan != nullptr) {
      trial.determined = is_determined(subject, scan->truth, scan->samples);
      trial.error = mdat::symmetric_error(mdat::registration_pose(scan->telemetry), scan->truth,
                                          mdat::registration_covariance(scan->telemetry), subject.truth.symmetry);
    }
    trial.settled = trial.settled || trial.valid;
    tally.add(trial, subject.truth.size_m);
    flight.push_back({frame.t_s, trial.is_wrong(subject.truth.size_m)});
  }
  tally.alert.add(mdat::wrong_episodes(flight, result.end_s));
}

}  // namespace

Tally track(const Subject& subject, std::size_t flights, std::uint32_t frames) {
  Tally tally;
  std::atomic<std::size_t> done{0};
  for (std::size_t flight = 0; flight < flights; ++flight) {
    std::uint64_t state = subject.body.seed * 1000 + flight;
    sim::Random random(sim::split_mix64(state));
    const std::uint64_t seed = random.bits() >> 32;  // as the command line takes it
    const mdat::Scenario scenario = flight_of(subject, random);
    mdat::CaseSetup setup = mdat::plain_case(subject.mission.source, scenario, seed, frames);
    const std::vector<std::uint8_t> image = mdat::image_bytes(subject.mission, setup.parameters);
    setup.image = &image;
    setup.target = &subject.target->surface();
    setup.alone = true;
    setup.keep_frames.resize(frames);
    std::iota(setup.keep_frames.begin(), setup.keep_frames.end(), 0U);
    const std::size_t wrong_before = tally.wrong;
    judge(subject, flight, mdat::run_case(setup, done), tally);
    if (tally.wrong > wrong_before) tally.again.push_back(again_text(subject, scenario, seed, frames));
    ++tally.numbers;
  }
  return tally;
}

}  // namespace lasso::bodies
