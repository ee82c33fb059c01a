#include <algorithm>
#include <cmath>
#include <functional>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMostTurn_rad = 4.5 * kRadPerDeg;     // in a scan, at a rate that the start does not know
constexpr double kHopelessTurn_rad = 8 * kRadPerDeg;   // there every pose was invalid
constexpr double kMostStep_rad = 12 * kRadPerDeg;      // from scan to scan, of a target that stands still in each
constexpr double kRateSigmas = 2.5;                    // of what the filter takes a rate at the start for
constexpr double kSearchedTurn_rad = 15 * kRadPerDeg;  // between two scans of a search, which are 2 s apart
constexpr double kBetweenScans_s = 2;
constexpr double kNoiseRatio = 3;  // of the simulated noise over the one that is assumed
constexpr double kReturning = 0.6;
constexpr double kSettlingFrames = 20;             // after them a filter knows the rates, and results count them
constexpr double kNever_s = 1e6;                   // what navigation_from_s says where none helps
constexpr double kNavigationShare = 0.25;          // of the target's length: as much as a rough start may be off
constexpr double kRadians_rad = 1.6 * kRadPerDeg;  // a quarter turn that was written in radians
constexpr double kOnTarget = 0.5;                  // of the rays

double norm(const std::vector<double>& v) { return std::hypot(v.at(0), v.at(1), v.at(2)); }

double rate_radps(const Subject& s) {
  if (s.scenario->scene != nullptr) return s.scenario->scene->rate_radps;
  return norm(s.scenario->spin_radps);
}

double drift_mps(const Subject& s) { return s.scenario->scene != nullptr ? 0 : norm(s.scenario->drift_mps); }

double end_s(const Subject& s) { return s.scenario->frames * s.p.period_s; }

std::string times_fault(const Subject& s) {
  const Scenario& scenario = *s.scenario;
  if (!scenario.has_profile() || scenario.times_s.size() == scenario.ranges_m.size()) return "";
  return "expected one for each of ranges_m, which are " + std::to_string(scenario.ranges_m.size());
}

std::string back_fault(const Subject& s) {
  const std::vector<double>& times = s.scenario->times_s;
  const auto back = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>());
  if (!s.scenario->has_profile() || back == times.end()) return "";
  return "expected more than the time before it, " + number_text(back[0]) + " s, of " + number_text(back[1]) + " s";
}

std::string eclipse_fault(const Subject& s) {
  if (s.scenario->eclipse_s[1] >= s.scenario->eclipse_s[0]) return "";
  return "expected an end that is not before the begin, " + number_text(s.scenario->eclipse_s[0]) + " s";
}

std::string late_eclipse_fault(const Subject& s) {
  if (s.scenario->eclipse_s[0] <= 0 || s.scenario->eclipse_s[0] < end_s(s)) return "";
  return "begins after the run, which ends at " + figure(end_s(s)) + " s";
}

// Those of the ranges that no sensor measures.
std::vector<double> unmeasured_m(const Subject& s) {
  const std::vector<SensorInUse> sensors = sensors_in_use(s.source, s.p, s.scenario);
  std::vector<double> unmeasured;
  for (const double range_m : s.scenario->ranges_m) {
    const auto measures = [&](const SensorInUse& sensor) { return range_m > sensor.p.range_min_m && range_m < sensor.p.range_max_m; };
    if (std::none_of(sensors.begin(), sensors.end(), measures)) unmeasured.push_back(range_m);
  }
  return unmeasured;
}

std::string unmeasured_text(const Subject& s, double range_m) {
  std::string known;
  for (const SensorInUse& sensor : sensors_in_use(s.source, s.p, s.scenario))
    known += (known.empty() ? "" : ", or ") + number_text(sensor.p.range_min_m) + " m and " + number_text(sensor.p.range_max_m) + " m";
  return "expected between sensor.range_min_m and sensor.range_max_m, which are " + known + ": " + number_text(range_m) + " m is not";
}

// A way may begin or end where nothing is measured yet, or any more.
bool is_partly_measured(const Subject& s) { return s.scenario->has_profile() && unmeasured_m(s).size() < s.scenario->ranges_m.size(); }

std::string ranges_fault(const Subject& s) {
  const std::vector<double> unmeasured = unmeasured_m(s);
  return unmeasured.empty() || is_partly_measured(s) ? "" : unmeasured_text(s, unmeasured.front());
}

std::string partly_measured_fault(const Subject& s) {
  const std::vector<double> unmeasured = unmeasured_m(s);
  if (unmeasured.empty() || !is_partly_measured(s)) return "";
  return "at " + std::to_string(unmeasured.size()) + " of " + std::to_string(s.scenario->ranges_m.size()) +
         " ranges nothing is measured: " + unmeasured_text(s, unmeasured.front());
}

std::string spin_fault(const Subject& s) {
  const double turn_rad = rate_radps(s) * s.p.duration_s;
  if (turn_rad <= kMostTurn_rad) return "";
  return "the target turns by " + degrees_text(turn_rad) + " in a scan and by " + degrees_text(rate_radps(s) * s.p.period_s) +
         " from one to the next, at a rate that no start knows: beyond " + degrees_text(kMostTurn_rad) +
         " in a scan the first ones are twisted too much, and from " + degrees_text(kHopelessTurn_rad) + " on none was registered";
}

std::string spin_sigma_fault(const Subject& s) {
  if (rate_radps(s) <= kRateSigmas * s.p.initial_angular_rate_radps) return "";
  return "is " + figure(rate_radps(s) / s.p.initial_angular_rate_radps) + " sigmas of filter.initial_angular_rate_degps, which is " +
         figure(s.p.initial_angular_rate_radps / kRadPerDeg);
}

std::string drift_sigma_fault(const Subject& s) {
  const double speed_mps = drift_mps(s);
  if (speed_mps <= kRateSigmas * s.p.initial_rate_mps) return "";
  return "is " + figure(speed_mps / s.p.initial_rate_mps) + " sigmas of filter.initial_rate_mps, which is " + figure(s.p.initial_rate_mps);
}

bool is_searched(const Subject& s) { return s.scenario->seeks_bearing() && is_in_order(s.p, kSearchSource); }

std::string searched_spin_fault(const Subject& s) {
  const double turn_rad = rate_radps(s) * kBetweenScans_s;
  if (!is_searched(s) || turn_rad <= kSearchedTurn_rad) return "";
  return "the target turns by " + degrees_text(turn_rad) + " between two scans of a search, which are " + figure(kBetweenScans_s) +
         " s apart: by more than " + degrees_text(kSearchedTurn_rad) + " its poses are not found again";
}

std::string step_fault(const Subject& s) {
  if (s.scenario->scene != nullptr || std::fabs(s.scenario->step_rad) <= kMostStep_rad) return "";
  return "the target turns by more than " + degrees_text(kMostStep_rad) + " from scan to scan: tracks are lost";
}

bool is_moved(const Subject& s) { return s.scenario->has_profile() || rate_radps(s) > 0 || drift_mps(s) > 0; }

std::string moved_steps_fault(const Subject& s) {
  if (s.scenario->scene != nullptr || s.scenario->step_rad == 0 || !is_moved(s)) return "";
  return "a target that turns from frame to frame stands still in each: expected 0, or no times_s, spin_degps and drift_mps";
}

std::string moved_variants_fault(const Subject& s) {
  if (s.scenario->variants == 0 || !is_moved(s)) return "";
  return "the bound that variants are compared with is of a target that stands still in each scan: expected ranges_m and step_deg alone "
         "to say where it is, without times_s, spin_degps and drift_mps";
}

std::string many_runs_fault(const Subject& s) {
  if (s.scenario->autonomous == 0 || s.scenario->runs_m().size() == 1) return "";
  return "is one run: expected one of ranges_m, or times_s for them, which say when the target is at each";
}

std::string no_way_fault(const Subject& s) {
  if (!s.scenario->seeks_bearing() || is_in_order(s.p, kSearchSource)) return "";
  if (s.scenario->autonomous != 0 && is_in_order(s.p, kNavigationSource) && s.scenario->navigation_from_s < end_s(s)) return "";
  return "no pose is given, and \"search\" is none of start.first to start.fifth: the component finds the bearing, and never a pose";
}

// Of a way through the bands of several sensors, the first range that is in none.
std::string band_gap_fault(const Subject& s) {
  const auto [low, high] = std::minmax_element(s.scenario->ranges_m.begin(), s.scenario->ranges_m.end());
  const std::vector<SensorInUse> sensors = sensors_in_use(s.source, s.p, s.scenario);
  double reached_m = *low;  // from there on, in some band
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    for (const SensorInUse& sensor : sensors) {
      if (sensor.p.use_from_m <= reached_m && sensor.p.use_to_m > reached_m) reached_m = sensor.p.use_to_m;
    }
  }
  if (sensors.size() == 1 || !s.scenario->has_profile() || reached_m >= *high) return "";
  return "from " + figure(reached_m) + " m on the target is in no sensor's band (use_from_m, use_to_m), on its way from " + figure(*low) +
         " m to " + figure(*high) + " m: any sensor that measures it is used";
}

std::string short_run_fault(const Subject& s) {
  if (!s.scenario->has_profile() || end_s(s) >= s.scenario->times_s.back() - s.p.period_s) return "";
  return "the run ends after " + figure(end_s(s)) + " s, and times_s at " + figure(s.scenario->times_s.back()) + " s: expected " +
         number_text(std::ceil(s.scenario->times_s.back() / s.p.period_s)) + " frames of " + figure(s.p.period_s) + " s";
}

std::string few_frames_fault(const Subject& s) {
  if (s.scenario->frames >= kSettlingFrames || s.scenario->variants != 0) return "";
  return "a run ends before its filter knows the rates, which takes some " + figure(kSettlingFrames) +
         " frames: results say nothing of them";
}

bool is_helped(const Subject& s) { return s.scenario->autonomous != 0 && is_in_order(s.p, kNavigationSource); }

std::string late_navigation_fault(const Subject& s) {
  const double from_s = s.scenario->navigation_from_s;
  if (!is_helped(s) || !no_way_fault(s).empty() || from_s < end_s(s) || from_s >= kNever_s) return "";
  return "is after the run, which ends at " + figure(end_s(s)) + " s: no pose is offered; " + number_text(kNever_s) + " says never";
}

std::string rough_navigation_fault(const Subject& s) {
  const double sigma_m = s.scenario->navigation_sigma_m, length_m = s.target->longest_m();
  if (!is_helped(s) || s.scenario->navigation_from_s >= end_s(s) || sigma_m <= kNavigationShare * length_m) return "";
  return "is " + percent_text(sigma_m / length_m) + " of the target's length of " + figure(length_m) +
         " m: a start may be off by a quarter of it, and 80 % or more of these are farther off";
}

std::string haste_fault(const Subject& s) {
  if (s.scenario->scene != nullptr) return "";  // scene_rules.cpp
  const std::vector<double>&times = s.scenario->times_s, &ranges = s.scenario->ranges_m;
  for (std::size_t i = 1; s.scenario->has_profile() && times.size() == ranges.size() && i < times.size(); ++i) {
    const double span_s = times[i] - times[i - 1], way_m = std::fabs(ranges[i] - ranges[i - 1]);
    const double most_mps2 = 6 * way_m / (span_s * span_s);  // of u^2 (3 - 2 u), at its ends
    if (span_s <= 0 || most_mps2 <= kAccelerations * s.p.acceleration_mps2) continue;
    return "from " + figure(ranges[i - 1]) + " m to " + figure(ranges[i]) + " m in " + figure(span_s) + " s takes " + figure(most_mps2) +
           " m/s2, and filter.acceleration_mps2 is " + figure(s.p.acceleration_mps2);
  }
  return "";
}

std::string smear_fault(const Subject& s) {
  if (s.p.deskew > 0.5 || s.source.sensor == SensorKind::kStereo) return "";  // cameras take all at once
  const double turned_m = rate_radps(s) * s.target->half_m(), moved_m = drift_mps(s);
  const double smear_m = (turned_m + moved_m) * s.p.duration_s;
  if (smear_m <= 2 * range_sigma_m(s.p, s.scenario->ranges_m.front())) return "";
  return "the target moves by " + figure(1e3 * smear_m) + " mm in a scan, and its points are left where they were measured";
}

std::string simulated_noise_fault(const Subject& s) {
  const Scenario& scenario = *s.scenario;
  for (const double range_m : scenario.ranges_m) {
    const double simulated_m = std::hypot(scenario.sigma0_m, scenario.sigma_k_per_m * range_m * range_m);
    const double assumed_m = range_sigma_m(s.p, range_m);
    if (scenario.noise == 0 || simulated_m <= kNoiseRatio * assumed_m) continue;
    return "the simulated noise is " + figure(1e3 * simulated_m) + " mm at " + figure(range_m) + " m, " + figure(simulated_m / assumed_m) +
           " times the " + figure(1e3 * assumed_m) + " mm of [sensor], by which returns are accepted and weighed";
  }
  return "";
}

std::string simulated_angle_fault(const Subject& s) {
  const Scenario& scenario = *s.scenario;
  const double range_m = *std::max_element(scenario.ranges_m.begin(), scenario.ranges_m.end());
  const double across_m = scenario.angle_noise_rad * range_m;
  const bool known = scenario.noise == 0 || scenario.angle_noise_rad <= kNoiseRatio * s.p.sigma_angle_rad;
  if (known || across_m <= 0.3 * range_sigma_m(s.p, range_m)) return "";
  return "moves a ray by " + figure(1e3 * across_m) + " mm at " + figure(range_m) + " m, and sensor.sigma_angle_rad, which is " +
         figure(s.p.sigma_angle_rad) + ", does not say so";
}

std::string simulated_common_fault(const Subject& s) {
  const Scenario& scenario = *s.scenario;
  const bool turned = scenario.common_sigma_rad > kNoiseRatio * s.p.common_sigma_rad;
  for (const double range_m : scenario.ranges_m) {
    const double simulated_m = scenario.common_sigma_m + scenario.common_sigma_k_per_m * range_m * range_m;
    const double stated_m = s.p.common_sigma_m + s.p.common_sigma_k_per_m * range_m * range_m;
    if (scenario.noise == 0 || (simulated_m <= kNoiseRatio * stated_m && !turned)) continue;
    return "rays of a scan have errors in common of " + figure(1e3 * simulated_m) + " mm at " + figure(range_m) + " m and " +
           figure(scenario.common_sigma_rad / kRadPerDeg) + " deg, where [sensor] states " + figure(1e3 * stated_m) + " mm and " +
           figure(s.p.common_sigma_rad / kRadPerDeg) + " deg: covariances will be too small";
  }
  return "";
}

std::string simulated_memory_fault(const Subject& s) {
  const Scenario& scenario = *s.scenario;
  const bool common = scenario.common_sigma_m + scenario.common_sigma_k_per_m + scenario.common_sigma_rad > 0;
  if (scenario.noise == 0 || !common || scenario.common_memory_s <= kNoiseRatio * s.p.common_memory_s) return "";
  return "simulated common errors last longer than sensor.common_memory_s says, which is " + figure(s.p.common_memory_s) +
         " s: the filter's covariance will be too small";
}

std::string outlier_fault(const Subject& s) {
  const double outliers = s.scenario->outlier_probability;
  const double explained = kOnTarget * (1 - outliers) / (kOnTarget * (1 - outliers) + outliers);
  const double asked = std::max({s.p.start_inlier_share_min, std::min(1.0, s.p.inlier_share_min + s.p.hysteresis), s.p.agreement_min});
  if (outliers == 0 || explained >= asked) return "";
  return "with half of the rays on the target a pose then explains " + percent_text(explained) +
         " of the returns, and a start has to explain " + percent_text(asked) + ": lower what asks for more of start.inlier_share_min (" +
         figure(s.p.start_inlier_share_min) + "), tracking.inlier_share_min (" + figure(s.p.inlier_share_min) +
         ") and tracking.agreement_min (" + figure(s.p.agreement_min) + ")";
}

std::string dropout_fault(const Subject& s) {
  if (s.scenario->dropout_probability <= s.p.dropout_probability + 1 - s.p.agreement_min) return "";
  return "of the simulated rays " + percent_text(s.scenario->dropout_probability) +
         " drop out, and of those that sensor.dropout_probability tells of " + percent_text(s.p.dropout_probability) +
         ": misses on the target count against its poses";
}

std::string grazing_fault(const Subject& s) {
  const double returning = std::pow(std::sin(s.scenario->dropout_incidence_rad), 2);
  const bool counts = s.scenario->dropout_incidence_rad < s.p.incidence_max_rad && returning < s.p.agreement_min;
  if (returning >= kReturning && !counts) return "";
  const std::string counting =
      "; misses on the target count against its poses, up to estimation.incidence_max_deg, which is " + degrees_text(s.p.incidence_max_rad);
  return "of the rays on a round target " + percent_text(returning) + " return" + (counts ? counting : "") +
         (s.scenario->dropout_incidence_rad < kRadians_rad ? "; in radians? " + figure(s.scenario->dropout_incidence_rad / kRadPerDeg) +
                                                                 " rad are " + degrees_text(s.scenario->dropout_incidence_rad / kRadPerDeg)
                                                           : "");
}

// Of a target before a sensor at rest: nodes say it by motions.
constexpr const char* kOfMotion[] = {"ranges_m", "times_s",  "tilt_deg", "boresight_deg", "roll_deg", "drawn",
                                     "offset_m", "center_m", "step_deg", "spin_degps",    "drift_mps"};
// Of the simulated navigation system, which helps an autonomous flight.
constexpr const char* kOfNavigation[] = {"navigation_period_s", "navigation_sigma_m", "navigation_sigma_deg"};

template <std::size_t kCount>
bool is_one_of(const std::string& key, const char* const (&keys)[kCount]) {
  return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

bool is_changed(const Scenario& scenario, const ScenarioField& field) {
  if (field.number != nullptr) return scenario.*field.number != field.row.preset.at(0) * field.row.to_si;
  const bool flown = field.list == &Scenario::ranges_m || field.list == &Scenario::times_s;
  if (flown && scenario.scene != nullptr) return false;  // these are where the motions lead
  std::vector<double> preset = field.row.preset;
  for (double& value : preset) value *= field.row.to_si;
  return scenario.*field.list != preset;
}

std::string idle_keys_fault(const Subject& s) {
  std::string keys;
  for (const ScenarioField& field : scenario_fields()) {
    if (has_effect(*s.scenario, field.row.key) || !is_changed(*s.scenario, field)) continue;
    keys += (keys.empty() ? "" : ", ") + field.row.key;
  }
  return keys.empty() ? "" : "of this scenario's keys these have no effect: " + keys;
}

bool has_corners(const std::vector<double>& box) {
  return std::any_of(box.begin(), box.end(), [](double value) { return value != 0; });
}

// Low corner, high corner.
std::string box_fault(const std::vector<double>& box) {
  if (!has_corners(box) || (box.at(0) < box.at(3) && box.at(1) < box.at(4) && box.at(2) < box.at(5))) return "";
  return "expected low x, y, z, then high x, y, z, each above its low one";
}
std::string gone_box_fault(const Subject& s) { return box_fault(s.scenario->model_gone_box_m); }
std::string turned_box_fault(const Subject& s) { return box_fault(s.scenario->model_turned_box_m); }

std::string turn_without_box_fault(const Subject& s) {
  const bool turns = norm(s.scenario->model_turn_rad) > 0;
  return turns && !has_corners(s.scenario->model_turned_box_m) ? "changes nothing: model_turned_box_m says which part turns" : "";
}

}  // namespace

bool is_of_motion(const Scenario& scenario, const std::string& key) { return scenario.scene != nullptr && is_one_of(key, kOfMotion); }

bool has_effect(const Scenario& scenario, const std::string& key) {
  if (key == "paper_table") return scenario.variants != 0;
  return !is_of_motion(scenario, key) && (scenario.autonomous != 0 || !is_one_of(key, kOfNavigation));
}

const Rules& scenario_rules() {
  using enum Severity;
  using enum Scope;
  using enum Needs;
  // clang-format off
  static const Rules rules = {
    {kError, kScenario, kValues, {"times_s", "ranges_m"}, times_fault},
    {kError, kScenario, kValues, {"times_s"}, back_fault},
    {kError, kScenario, kValues, {"eclipse_s"}, eclipse_fault},
    {kWarning, kScenario, kValues, {"eclipse_s", "frames"}, late_eclipse_fault},
    {kError, kScenario, kValues, {"ranges_m", "sensor.range_min_m", "sensor.range_max_m"}, ranges_fault},
    {kWarning, kScenario, kValues, {"ranges_m", "sensor.range_min_m", "sensor.range_max_m"}, partly_measured_fault},
    {kWarning, kScenario, kValues, {"spin_degps", "scan.duration_s"}, spin_fault},
    {kWarning, kScenario, kValues, {"spin_degps", "filter.initial_angular_rate_degps"}, spin_sigma_fault},
    {kWarning, kScenario, kValues, {"drift_mps", "filter.initial_rate_mps"}, drift_sigma_fault},
    {kWarning, kScenario, kValues, {"spin_degps", "start.first"}, searched_spin_fault},
    {kWarning, kScenario, kValues, {"step_deg"}, step_fault},
    {kError, kScenario, kValues, {"step_deg"}, moved_steps_fault},
    {kError, kScenario, kValues, {"variants"}, moved_variants_fault},
    {kError, kScenario, kValues, {"autonomous", "ranges_m"}, many_runs_fault},
    {kError, kScenario, kValues, {"model_gone_box_m"}, gone_box_fault},
    {kError, kScenario, kValues, {"model_turned_box_m"}, turned_box_fault},
    {kWarning, kScenario, kValues, {"model_turn_deg", "model_turned_box_m"}, turn_without_box_fault},
    {kWarning, kScenario, kValues, {"prior", "autonomous", "start.first"}, no_way_fault},
    {kWarning, kScenario, kValues, {"ranges_m", "sensor.use_from_m", "sensor.use_to_m"}, band_gap_fault},
    {kWarning, kScenario, kValues, {"frames", "times_s"}, short_run_fault},
    {kWarning, kScenario, kValues, {"frames"}, few_frames_fault},
    {kWarning, kScenario, kValues, {"navigation_from_s", "frames"}, late_navigation_fault},
    {kWarning, kScenario, kTarget, {"navigation_sigma_m"}, rough_navigation_fault},
    {kWarning, kScenario, kValues, {"times_s", "filter.acceleration_mps2"}, haste_fault},
    {kWarning, kScenario, kTarget, {"estimation.deskew", "spin_degps"}, smear_fault},
    {kWarning, kScenario, kValues, {"sigma_k_per_m", "sigma0_m", "sensor.sigma_k_per_m", "sensor.sigma0_m"}, simulated_noise_fault},
    {kWarning, kScenario, kValues, {"angle_noise_rad", "sensor.sigma_angle_rad"}, simulated_angle_fault},
    {kWarning,
     kScenario,
     kValues,
     {"common_sigma_m", "common_sigma_k_per_m", "common_sigma_deg", "sensor.common_sigma_m", "sensor.common_sigma_k_per_m",
      "sensor.common_sigma_deg"},
     simulated_common_fault},
    {kWarning, kScenario, kValues, {"common_memory_s", "sensor.common_memory_s"}, simulated_memory_fault},
    {kWarning, kScenario, kValues, {"outlier_probability", "start.inlier_share_min", "tracking.inlier_share_min", "tracking.agreement_min"}, outlier_fault},
    {kWarning, kScenario, kValues, {"dropout_probability", "sensor.dropout_probability", "tracking.agreement_min"}, dropout_fault},
    {kWarning, kScenario, kValues, {"dropout_incidence_deg", "estimation.incidence_max_deg", "tracking.agreement_min"}, grazing_fault},
    {kWarning, kScenario, kValues, {"frames"}, idle_keys_fault},
  };
  // clang-format on
  return rules;
}

}  // namespace lasso::mdat
