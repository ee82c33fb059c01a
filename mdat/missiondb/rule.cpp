#include "mdat/missiondb/rule.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

// The part of a run's way from low to high that lies in the sensor's band.
std::vector<double> part_in_band(double low_m, double high_m, const SensorParameters& sensor) {
  const double from_m = std::max(low_m, sensor.use_from_m);
  const double to_m = std::min(high_m, sensor.use_to_m);
  return from_m <= to_m ? std::vector<double>{from_m, to_m} : std::vector<double>{};
}

// A sensor that is alone takes all scans, whatever its band.
std::vector<double> ranges_in_use(const Scenario& scenario, const SensorParameters& sensor, bool alone) {
  if (alone) return scenario.ranges_m;
  const auto [low, high] = std::minmax_element(scenario.ranges_m.begin(), scenario.ranges_m.end());
  if (scenario.has_profile()) return part_in_band(*low, *high, sensor);
  std::vector<double> ranges;
  for (const double range_m : scenario.ranges_m) {
    if (range_m >= sensor.use_from_m && range_m <= sensor.use_to_m) ranges.push_back(range_m);
  }
  return ranges;
}

}  // namespace

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string degrees_text(double rad) { return figure(rad / kRadPerDeg) + " deg"; }

std::string percent_text(double share) { return figure(100 * share) + " %"; }

bool is_in_order(const MissionParameters& p, double source) {
  const double order[] = {p.start_first, p.start_second, p.start_third, p.start_fourth, p.start_fifth};
  return std::find(std::begin(order), std::end(order), source) != std::end(order);
}

double range_sigma_m(const SensorParameters& sensor, double z_m) { return std::hypot(sensor.sigma0_m, sensor.sigma_k_per_m * z_m * z_m); }

std::vector<SensorInUse> sensors_in_use(const MissionSource& source, const MissionParameters& p, const Scenario* scenario) {
  std::vector<SensorInUse> sensors{{"sensor.", source.sensor, p, {}, source.flash}};
  for (const FurtherSensor& further : source.further_sensors) {
    sensors.push_back({"further_sensor." + further.name + ".", further.kind, further.parameters, {}, further.flash});
  }
  for (SensorInUse& sensor : sensors) {
    if (scenario != nullptr) sensor.ranges_m = ranges_in_use(*scenario, sensor.p, sensors.size() == 1);
  }
  return sensors;
}

Subject subject_of(const MissionSource& source, const std::string& scenario) {
  Subject subject{source, source.parameters, nullptr, scenario, nullptr, nullptr};
  if (scenario.empty()) return subject;
  subject.scenario = &source.scenarios.at(scenario);
  for (const ParameterRow& row : parameter_rows()) {
    const auto value = subject.scenario->overrides.find(row.key);
    if (value != subject.scenario->overrides.end()) subject.p.*row.member = value->second * row.to_si;
  }
  return subject;
}

}  // namespace lasso::mdat
