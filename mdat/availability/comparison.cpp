#include "mdat/availability/comparison.hpp"

#include <chrono>
#include <cmath>
#include <numeric>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/run/case_pool.hpp"

namespace lasso::mdat {
namespace {

std::vector<std::uint32_t> frames_to(std::uint32_t frames) {
  std::vector<std::uint32_t> numbers(frames);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

// Three cases at a time leave no core to a picture.
unsigned picture_jobs(unsigned jobs) { return std::max(1U, jobs / 3); }

void fly_approach(const ComparisonOptions& options, HeadComparison& comparison) {
  std::vector<std::unique_ptr<HeadFlights>> flights;
  std::vector<CaseSetup> cases;
  for (const HeadResult& result : comparison.heads) {
    flights.push_back(std::make_unique<HeadFlights>(options.mission, result.head, options.approach));
    const HeadFlights& of_head = *flights.back();
    const Scenario& scenario = of_head.scenario();
    const std::uint32_t frames = options.frames.value_or(static_cast<std::uint32_t>(scenario.frames));
    cases.push_back(of_head.flight(of_head.mission(), static_cast<std::uint64_t>(scenario.seed), frames, picture_jobs(options.jobs)));
    cases.back().keep_frames = frames_to(frames);
    comparison.mission = of_head.mission().source.name;
    comparison.period_s = cases.back().parameters.period_s;
  }
  ProgressBar bar("approach", cases.size() * cases.front().frames, "frames");
  std::vector<CaseResult> results = run_cases(cases, options.jobs, bar);
  bar.finish();
  for (std::size_t i = 0; i < results.size(); ++i) {
    const SceneRun& run = *cases[i].scenario.scene;
    comparison.heads[i].scans = std::move(results[i].scans);
    for (const FrameError& error : results[i].frames)
      comparison.heads[i].approach.push_back({error, light_at(run, static_cast<TimeUs>(std::llround(1e6 * error.t_s)))});
  }
}

// An orbit, and how the target's node stands in it.
struct OrbitPlace {
  double beta_deg = 0, angle_deg = 0;
  Quat q_root_target = Quat::Identity();
};

// Evenly over all attitudes (Shoemake, Graphics Gems III, 1992).
Quat drawn_attitude(std::uint64_t seed) {
  sim::Random random(seed);
  const double u = random.uniform(), a = 2 * kPi * random.uniform(), b = 2 * kPi * random.uniform();
  const double low = std::sqrt(1 - u), high = std::sqrt(u);
  return {high * std::cos(b), low * std::sin(a), low * std::cos(a), high * std::sin(b)};
}

std::vector<OrbitPlace> orbit_places(const ComparisonOptions& options) {
  std::vector<OrbitPlace> places;
  for (const double beta_deg : options.betas_deg) {
    for (std::uint32_t i = 0; i < options.angles; ++i)
      places.push_back({beta_deg, 360 * (i + 0.5) / options.angles - 180, drawn_attitude(1 + places.size())});
  }
  return places;
}

std::vector<std::string> settings_of(const OrbitPlace& place, const std::string& target) {
  const Quat& q = place.q_root_target;
  return {format("orbit.beta_deg=%.17g", place.beta_deg), format("orbit.angle_deg=%.17g", place.angle_deg),
          "node." + target + format(".quaternion=[%.17g, %.17g, %.17g, %.17g]", q.x(), q.y(), q.z(), q.w())};
}

// Cases of one frame each, one in each place; all of them with noise of their own, or of one seed.
struct PlacedCases {
  std::vector<std::unique_ptr<MissionInput>> missions;
  std::vector<CaseSetup> cases;
};

PlacedCases cases_in(const ComparisonOptions& options, const HeadFlights& flights, const std::vector<OrbitPlace>& places, bool one_seed) {
  PlacedCases placed;
  const std::string& target = flights.mission().source.scene.target;
  for (const OrbitPlace& place : places) {
    placed.missions.push_back(
        std::make_unique<MissionInput>(input_of_head(options.mission, flights.head(), options.hold, settings_of(place, target))));
    const std::uint64_t seed = one_seed ? 1 : 1 + placed.cases.size();
    placed.cases.push_back(flights.flight(*placed.missions.back(), seed, 1, 1));
  }
  return placed;
}

std::vector<OrbitSample> orbit_samples(const PlacedCases& placed, const std::vector<OrbitPlace>& places,
                                       const std::vector<CaseResult>& results) {
  std::vector<OrbitSample> samples;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const FrameError& error = results[i].frames.front();
    const LightAt light = light_at(*placed.cases[i].scenario.scene, static_cast<TimeUs>(std::llround(1e6 * error.t_s)));
    samples.push_back({places[i].beta_deg * kRadPerDeg, places[i].angle_deg * kRadPerDeg, {error, light}});
  }
  return samples;
}

bool stands_alike(const CaseSetup& a, const CaseSetup& b) {
  const Pose one = a.scenario.scene->target_at(0).T_a_b, other = b.scenario.scene->target_at(0).T_a_b;
  return one.p == other.p && one.q.coeffs() == other.q.coeffs();
}

LaserInLight laser_in_light(const ComparisonOptions& options, const HeadFlights& laser, std::vector<OrbitPlace> places) {
  for (OrbitPlace& place : places) place.q_root_target = places.front().q_root_target;
  const PlacedCases placed = cases_in(options, laser, places, true);
  if (placed.cases.size() < 2) return LaserInLight::kNotCompared;
  ProgressBar bar("laser in each light", placed.cases.size(), "frames", 1);
  const std::vector<CaseResult> results = run_cases(placed.cases, options.jobs, bar);
  bar.finish();
  LaserInLight found = LaserInLight::kSameBits;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (!stands_alike(placed.cases[i], placed.cases[0])) return LaserInLight::kOtherMotion;
    if (results[i].telemetry != results[0].telemetry) found = LaserInLight::kOtherBits;
  }
  return found;
}

void fly_orbits(const ComparisonOptions& options, HeadComparison& comparison) {
  const std::vector<OrbitPlace> places = orbit_places(options);
  for (HeadResult& result : comparison.heads) {
    if (places.empty()) return;
    const HeadFlights flights(options.mission, result.head, options.hold);
    const PlacedCases placed = cases_in(options, flights, places, false);
    ProgressBar bar("orbits, " + result.head.title, placed.cases.size(), "frames");
    result.orbits = orbit_samples(placed, places, run_cases(placed.cases, options.jobs, bar));
    bar.finish();
    if (&result == &comparison.heads.front()) comparison.laser = laser_in_light(options, flights, places);
  }
}

}  // namespace

HeadComparison compare_heads(const ComparisonOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  HeadComparison comparison;
  comparison.approach = options.approach;
  comparison.hold = options.hold;
  for (Head& head : heads_of(options.mission)) comparison.heads.push_back({std::move(head), {}, {}, {}});
  fly_approach(options, comparison);
  fly_orbits(options, comparison);
  comparison.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return comparison;
}

}  // namespace lasso::mdat
