#include "mdat/paper/laboratory.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "fsw/geometry/so3.hpp"
#include "fsw/sense/pattern.hpp"
#include "fsw/sense/planner.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/run/case_pool.hpp"
#include "mdat/run/simulation.hpp"
#include "mdat/run/true_target.hpp"

namespace lasso::mdat {
namespace {

constexpr double kNoError = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kBudgetScans = 4;  // whose patterns stand for all of a stand
constexpr std::uint64_t kMockUpStream = 0x6d6f636b7570U;

double step_rad(const LaboratoryOptions& options) { return 2 * kPi / options.stands; }

// The scenario of one stand: the target at rest, turned by `stand` steps.
Scenario stand_scenario(Scenario scenario, const LaboratoryOptions& options, std::uint32_t stand) {
  scenario.step_rad = 0;
  scenario.roll_rad += stand * step_rad(options);
  return scenario;
}

Pose true_pose(const Scenario& stand, double range_m) { return make_trajectory(stand, range_m, kEpochUs, 1)->at(kEpochUs).T_sensor_target; }

// Each range has mock-ups of its own: a budget is of all that could have been built, and few of them would be a matter of luck.
std::uint64_t mock_up_seed(const Scenario& scenario, double range_m, std::uint32_t mock_up) {
  std::uint64_t state = static_cast<std::uint64_t>(scenario.seed) ^ kMockUpStream ^ (std::uint64_t{mock_up} << 40);
  return sim::split_mix64(state) ^ static_cast<std::uint64_t>(to_us(range_m));
}

// Of the noise and the common errors; plain_case mixes the range in.
std::uint64_t stand_seed(const Scenario& scenario, std::uint32_t mock_up, std::uint32_t stand) {
  std::uint64_t state = static_cast<std::uint64_t>(scenario.seed) ^ (std::uint64_t{mock_up + 1} << 32) ^ (std::uint64_t{stand + 1} << 20);
  return sim::split_mix64(state);
}

std::uint32_t frames_of(const MissionSource& source, const LaboratoryOptions& options) {
  return options.frames.value_or(static_cast<std::uint32_t>(source.scenarios.begin()->second.frames));
}

// The cases of a test, range by range, with all that they point to.
struct LaboratoryPlan {
  std::vector<std::vector<std::uint8_t>> images;          // of each scenario
  std::vector<std::unique_ptr<sim::RayCaster>> mock_ups;  // of each range
  std::vector<CaseSetup> cases;
};

struct RangePlace {
  std::string scenario;
  std::size_t scenario_index = 0, range = 0;
};

void plan_range(const CompiledMission& mission, const LaboratoryOptions& options, const RangePlace& place, LaboratoryPlan& plan) {
  const Scenario& scenario = scenario_of(mission.source, place.scenario);
  const double range_m = scenario.ranges_m.at(place.range);
  for (std::uint32_t mock_up = 0; mock_up < options.mock_ups; ++mock_up) {
    plan.mock_ups.push_back(simulated_target(mission.mesh, scenario, mock_up_seed(scenario, range_m, mock_up)));
    for (std::uint32_t stand = 0; stand < options.stands; ++stand) {
      CaseSetup setup = plain_case(mission.source, stand_scenario(scenario, options, stand), stand_seed(scenario, mock_up, stand),
                                   frames_of(mission.source, options), place.range);
      setup.parameters = parameters_for(mission.source, place.scenario);
      setup.image = &plan.images.at(place.scenario_index);
      setup.target = plan.mock_ups.back().get();
      setup.alone = true;
      plan.cases.push_back(std::move(setup));
    }
  }
}

// All ranges in the order of the scenarios.
std::vector<RangePlace> places_of(const MissionSource& source) {
  std::vector<RangePlace> places;
  std::size_t index = 0;
  for (const auto& [name, scenario] : source.scenarios) {
    for (std::size_t range = 0; range < scenario.ranges_m.size(); ++range) places.push_back({name, index, range});
    ++index;
  }
  return places;
}

LaboratoryPlan make_laboratory_plan(const CompiledMission& mission, const LaboratoryOptions& options) {
  LaboratoryPlan plan;
  for (const auto& [name, scenario] : mission.source.scenarios)
    plan.images.push_back(image_bytes(mission, parameters_for(mission.source, name)));
  for (const RangePlace& place : places_of(mission.source)) plan_range(mission, options, place, plan);
  return plan;
}

// What a frame estimated, from its error.
Pose estimate_of(const PoseError& error, const Pose& truth) {
  const Vec3& ypr = error.yaw_pitch_roll;
  const Quat turn = exp_so3(ypr[0] * Vec3::UnitZ()) * exp_so3(ypr[1] * Vec3::UnitY()) * exp_so3(ypr[2] * Vec3::UnitX());
  return {normalized(truth.q * turn), truth.p + error.translation_m};
}

StandResult stand_of(const CaseSetup& setup, const CaseResult& run, std::vector<double>& times_us) {
  StandResult stand;
  stand.truth = true_pose(setup.scenario, setup.range_m);
  stand.errors.fill(kNoError);
  std::vector<Pose> estimates;
  for (const FrameError& frame : run.frames) {
    ++stand.frames;
    stand.invalid += frame.valid ? 0U : 1U;
    stand.lost += frame.lost() ? 1U : 0U;
    if (frame.reported) times_us.push_back(frame.estimate_us);
    if (!frame.lost()) estimates.push_back(estimate_of(frame.registration, stand.truth));
  }
  if (estimates.empty()) return stand;
  stand.mean = mean_of_stand(estimates);
  stand.errors[static_cast<std::size_t>(LaboratoryFigure::kZ)] = stand.mean->pose.p.z() - stand.truth.p.z();
  stand.errors[static_cast<std::size_t>(LaboratoryFigure::kTurn)] = turn_about_x(stand.truth.q, stand.mean->pose.q);
  return stand;
}

// Against the stand before; of each mock-up's first there is none.
void compare_stands(const LaboratoryOptions& options, std::vector<StandResult>& stands) {
  for (std::size_t i = 0; i < stands.size(); ++i) {
    if (i % options.stands == 0) continue;
    const std::optional<StandMean>&before = stands[i - 1].mean, &after = stands[i].mean;
    if (!before || !after) continue;
    stands[i].errors[static_cast<std::size_t>(LaboratoryFigure::kZStep)] = after->pose.p.z() - before->pose.p.z();
    stands[i].errors[static_cast<std::size_t>(LaboratoryFigure::kTurnStep)] = turn_error(before->pose.q, after->pose.q, step_rad(options));
  }
}

BudgetAssumptions assumptions_of(const Scenario& scenario, const MissionParameters& parameters, std::uint32_t frames) {
  BudgetAssumptions assumptions;
  assumptions.sensor = scanner_model(scenario, parameters, scenario.noise != 0);
  assumptions.vertex_sigma_m = scenario.model_vertex_sigma_m;
  assumptions.scans = frames;
  assumptions.sigma0_m = parameters.sigma0_m;
  assumptions.sigma_k_per_m = parameters.sigma_k_per_m;
  assumptions.sigma_angle_rad = parameters.sigma_angle_rad;
  assumptions.surface_sigma_m = parameters.surface_sigma_m;
  assumptions.incidence_max_rad = parameters.incidence_max_rad;
  return assumptions;
}

// The rays that the component would plan for a target at its pose.
std::vector<std::vector<Vec3>> planned_scans(const Mission& mission, const Pose& T_sensor_target, std::uint32_t count) {
  std::vector<std::vector<Vec3>> scans;
  for (std::uint32_t scan = 0; scan < count; ++scan) {
    ScanPlan plan;
    if (plan_scan(mission.parameters, {mission.hull, mission.center_m}, T_sensor_target, scan, plan) != Status::kOk)
      throw RunError("the laboratory's target is out of the sensor's field");
    scans.emplace_back();
    for (PatternGenerator rays(plan); !rays.done();) scans.back().push_back(rays.next().normalized());
  }
  return scans;
}

std::array<Variances, kLaboratoryFigures> stand_budget(const StandResponse& before, const StandResponse& now, double vertex_sigma_m) {
  return {variances_of(now.z_m, vertex_sigma_m), variances_of(now.turn_rad, vertex_sigma_m),
          variances_between(before.z_m, now.z_m, vertex_sigma_m), variances_between(before.turn_rad, now.turn_rad, vertex_sigma_m)};
}

}  // namespace

void check_laboratory(const MissionSource& source) {
  if (source.scenarios.empty())
    throw InputError(source.file.string() + ": has no scenario: a laboratory's mission has one or more with variants = true");
  const double frames = source.scenarios.begin()->second.frames;
  std::vector<Problem> problems;
  for (const auto& [name, scenario] : source.scenarios) {
    const auto refuse = [&, key = "scenario." + name](const char* what, double value, const std::string& expected) {
      problems.push_back(problem_at(source, key + what, value < 0 ? "" : format("%g", value), expected));
    };
    if (scenario.variants == 0) refuse(".variants", -1, "expected true, as in all scenarios of a laboratory");
    if (scenario.step_rad != 0)
      refuse(".step_deg", std::fabs(scenario.step_rad) / kRadPerDeg,
             "expected 0: the target rests in a stand, and --stands says how far apart they are");
    if (scenario.frames != frames)
      refuse(".frames", scenario.frames, format("expected %g, as in the mission's first scenario: stands are alike", frames));
  }
  if (!problems.empty()) throw MissionError(problems);
}

std::vector<std::array<Variances, kLaboratoryFigures>> laboratory_budget(const CompiledMission& mission, const std::string& scenario_name,
                                                                         std::size_t range, const LaboratoryOptions& options) {
  const Scenario& scenario = scenario_of(mission.source, scenario_name);
  const MissionParameters parameters = parameters_for(mission.source, scenario_name);
  const LoadedImage image(mission.source.name, image_bytes(mission, parameters));
  const std::uint32_t frames = frames_of(mission.source, options);
  const BudgetAssumptions assumptions = assumptions_of(scenario, parameters, frames);
  const BudgetTarget target(mission.mesh);
  std::vector<std::array<Variances, kLaboratoryFigures>> budget;
  StandResponse before;
  for (std::uint32_t stand = 0; stand < options.stands; ++stand) {
    const Pose truth = true_pose(stand_scenario(scenario, options, stand), scenario.ranges_m.at(range));
    const StandResponse now = target.stand(assumptions, truth, planned_scans(image.mission(), truth, kBudgetScans));
    if (!now.defined) throw RunError("the laboratory's scans leave a direction open");
    budget.push_back(stand_budget(stand == 0 ? now : before, now, scenario.model_vertex_sigma_m));
    before = now;
  }
  return budget;
}

LaboratoryResult fly_laboratory(const CompiledMission& mission, const LaboratoryOptions& options) {
  check_laboratory(mission.source);
  const auto begin = std::chrono::steady_clock::now();
  LaboratoryResult result;
  result.frames = frames_of(mission.source, options);
  result.stands = options.stands;
  result.mock_ups = options.mock_ups;
  for (const auto& [name, scenario] : mission.source.scenarios) result.scenarios.push_back(scenario);
  const std::vector<RangePlace> places = places_of(mission.source);
  for (const RangePlace& place : places) {
    const Scenario& scenario = scenario_of(mission.source, place.scenario);
    result.ranges.push_back(
        {place.scenario, scenario.ranges_m.at(place.range), {}, laboratory_budget(mission, place.scenario, place.range, options)});
  }
  const LaboratoryPlan plan = make_laboratory_plan(mission, options);
  ProgressBar bar("laboratory", plan.cases.size() * result.frames, "frames");
  const std::vector<CaseResult> runs = run_cases(plan.cases, options.jobs, bar);
  bar.finish();
  std::vector<double> times_us;
  const std::size_t each = std::size_t{options.mock_ups} * options.stands;
  for (std::size_t i = 0; i < runs.size(); ++i) result.ranges[i / each].stands.push_back(stand_of(plan.cases[i], runs[i], times_us));
  for (LaboratoryRange& range : result.ranges) compare_stands(options, range.stands);
  result.time = time_statistics(times_us);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

FigureErrors figure_errors(const LaboratoryResult& result, LaboratoryFigure figure, std::optional<std::size_t> only) {
  const auto place = static_cast<std::size_t>(figure);
  FigureErrors errors;
  double squares = 0;
  std::vector<double> absolute;
  Variances variances{};
  for (std::size_t r = 0; r < result.ranges.size(); ++r) {
    if (only && *only != r) continue;
    const LaboratoryRange& range = result.ranges[r];
    for (std::size_t i = 0; i < range.stands.size(); ++i) {
      const double error = range.stands[i].errors[place];
      if (!std::isfinite(error)) continue;
      absolute.push_back(std::fabs(error));
      squares += error * error;
      for (std::size_t s = 0; s < kBudgetSources; ++s) variances[s] += range.budget[i % result.stands][place][s];
    }
  }
  errors.count = absolute.size();
  const auto count = static_cast<double>(errors.count);
  const MeanStd statistics = mean_std(absolute);
  errors.mean_abs = statistics.mean;
  errors.std_abs = statistics.std;
  errors.rms = std::sqrt(squares / count);
  errors.budget = std::sqrt(total(variances) / count);
  for (std::size_t s = 0; s < kBudgetSources; ++s) errors.budget_by_source[s] = std::sqrt(variances[s] / count);
  return errors;
}

}  // namespace lasso::mdat
