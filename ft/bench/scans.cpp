#include "ft/bench/scans.hpp"

#include "fsw/sense/planner.hpp"
#include "hal_sim/random.hpp"
#include "hal_sim/scanner.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::bench {
namespace {

// All that one range's scans have in common.
struct Range {
  const Mission& mission;
  const sim::RayCaster& target;
  sim::ScannerModel noise_model;  // of the bound, whether or not the scans are noisy
  std::unique_ptr<sim::Trajectory> trajectory;
  DurationUs period_us;
};

std::vector<RangeSample> run_scan(Sensor& scanner, const ScanPlan& plan, TimeUs begin_us) {
  if (scanner.start(plan, begin_us) != Status::kOk) throw mdat::RunError("the simulated scanner refuses a scan");
  std::vector<RangeSample> samples(plan.points);
  const SensorPoll polled = scanner.poll(begin_us + plan.duration_us, {samples.data(), samples.size()});
  if (polled.status != Status::kOk || !polled.complete) throw mdat::RunError("the simulated scanner does not finish a scan");
  samples.resize(polled.count);
  return samples;
}

Scan make_scan(const Range& range, Sensor& scanner, std::uint32_t frame) {
  const TimeUs begin_us = mdat::kEpochUs + frame * range.period_us;
  Scan scan;
  scan.frame = frame;
  scan.truth = range.trajectory->at(begin_us).T_sensor_target;
  scan.start = range.trajectory->at(begin_us - range.period_us).T_sensor_target;
  ScanPlan plan;
  const TargetOutline outline{range.mission.hull, range.mission.center_m};
  if (plan_scan(range.mission.parameters, outline, scan.start, frame, plan) != Status::kOk) throw mdat::RunError("a scan has no plan");
  scan.samples = run_scan(scanner, plan, begin_us);
  scan.bound = mdat::pose_bound(range.target, scan.truth, scan.samples, [&](double z_m) { return range_sigma_m(range.noise_model, z_m); });
  return scan;
}

std::uint64_t range_seed(const mdat::Scenario& scenario, std::size_t range) {
  std::uint64_t state = static_cast<std::uint64_t>(scenario.seed) ^ std::uint64_t{range} << 48;
  return sim::split_mix64(state);
}

}  // namespace

std::unique_ptr<mdat::LoadedImage> make_image(const mdat::CompiledMission& mission, const std::string& scenario, bool silhouettes) {
  MissionParameters parameters = mdat::parameters_for(mission.source, scenario);
  parameters.silhouettes = silhouettes ? 1 : 0;
  return std::make_unique<mdat::LoadedImage>(mission.source.name, mdat::image_bytes(mission, parameters));
}

std::vector<Scan> make_scans(const mdat::CompiledMission& mission, const ScanOptions& options) {
  const mdat::Scenario& scenario = mdat::scenario_of(mission.source, options.scenario);
  if (scenario.variants == 0) throw mdat::InputError(options.scenario + ": its target moves during the scans");
  const auto image = make_image(mission, options.scenario, true);
  const MissionParameters& parameters = image->mission().parameters;
  const auto target = mdat::make_target(mission.mesh);
  const DurationUs period_us = mdat::period_us(parameters);
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < scenario.runs_m().size(); ++i) {
    const double range_m = scenario.runs_m()[i];
    const Range range{image->mission(), *target, mdat::scanner_model(scenario, parameters, true),
                      mdat::make_trajectory(scenario, range_m, mdat::kEpochUs, period_us), period_us};
    sim::SimulatedScanner scanner(*target, *range.trajectory, mdat::scanner_model(scenario, parameters, options.noise),
                                  range_seed(scenario, i));
    for (std::uint32_t frame = 0; frame < scenario.frames; frame += options.stride) {
      scans.push_back(make_scan(range, scanner, frame));
      scans.back().range_m = range_m;
    }
  }
  return scans;
}

void to_range_image(const Scan& scan, RangeImage& image) {
  image.scan_id = scan.frame;
  image.misses_known = true;
  image.samples.clear();
  for (const RangeSample& sample : scan.samples) {
    if (!image.samples.push_back(sample)) throw mdat::RunError("a scan is larger than a range image");
  }
}

}  // namespace lasso::bench
