#include "mdat/missiondb/mission_checks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "cfg/capacities.hpp"
#include "fsw/sense/scan_plan.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

using Parameters = MissionParameters;

void check_band(const std::string& from_key, double from_m, const std::string& to_key, double to_m, const Complaint& complain) {
  if (from_m < to_m) return;
  complain({from_key, to_key}, number_text(from_m), "expected less than " + to_key + ", which is " + number_text(to_m) + " m");
}

void check_sensor_under(const std::string& prefix, const SensorParameters& sensor, const Complaint& complain) {
  check_band(prefix + "range_min_m", sensor.range_min_m, prefix + "range_max_m", sensor.range_max_m, complain);
  check_band(prefix + "use_from_m", sensor.use_from_m, prefix + "use_to_m", sensor.use_to_m, complain);
}

void check_points(const Parameters& p, const Complaint& complain) {
  if (p.points > static_cast<double>(kMaxRays)) {
    complain({"scan.points"}, number_text(p.points), "the flight component has room for " + std::to_string(kMaxRays) + " rays");
  }
  if (p.inliers_min > p.points) {
    complain({"tracking.inliers_min", "scan.points"}, number_text(p.inliers_min),
             "expected at most scan.points, which is " + number_text(p.points));
  }
}

void check_pattern(const Parameters& p, const Complaint& complain) {
  const auto a = static_cast<int>(p.cycles_a);
  const auto b = static_cast<int>(p.cycles_b);
  const auto kind = static_cast<PatternKind>(static_cast<int>(p.pattern));
  if (kind == PatternKind::kRaster) {
    if (p.points < 2 * p.cycles_a) {
      complain({"scan.cycles_a", "scan.points"}, std::to_string(a),
               "a raster needs at least 2 points a line: fewer lines, or more scan.points");
    }
  } else if (a == b || std::gcd(a, b) != 1) {
    complain({"scan.cycles_b", "scan.cycles_a", "scan.pattern"}, std::to_string(b),
             "expected a count that differs from scan.cycles_a, which is " + std::to_string(a) +
                 ", and has no common divisor with it; otherwise the curve repeats itself");
  }
}

void check_duration(const Parameters& p, const Complaint& complain) {
  if (p.duration_s < p.period_s) return;
  complain({"scan.duration_s", "filter.period_s"}, number_text(p.duration_s),
           "expected less than filter.period_s, which is " + number_text(p.period_s) + " s: a scan ends before the next begins");
}

double quaternion_length(const Parameters& p) {
  return std::sqrt(p.initial_qx * p.initial_qx + p.initial_qy * p.initial_qy + p.initial_qz * p.initial_qz + p.initial_qw * p.initial_qw);
}

void check_initial(const Parameters& p, const Complaint& complain) {
  const double length = quaternion_length(p);
  if (!(std::fabs(length - 1) <= kQuaternionTolerance)) {
    const std::string value = "[" + number_text(p.initial_qx) + ", " + number_text(p.initial_qy) + ", " + number_text(p.initial_qz) + ", " +
                              number_text(p.initial_qw) + "]";
    complain({"tracking.initial.qw", "tracking.initial.qx", "tracking.initial.qy", "tracking.initial.qz"}, value,
             "expected a quaternion of unit length (within " + number_text(kQuaternionTolerance) + "), this one's length is " +
                 number_text(length));
  }
  if (p.initial_present != 0 && p.initial_z_m <= 0) {
    complain({"tracking.initial.z_m", "tracking.initial.present"}, number_text(p.initial_z_m),
             "expected more than 0: the target is in front");
  }
}

void check_order(const Parameters& p, const Complaint& complain) {
  const std::vector<std::pair<std::string, double>> order = {{"start.first", p.start_first},
                                                             {"start.second", p.start_second},
                                                             {"start.third", p.start_third},
                                                             {"start.fourth", p.start_fourth},
                                                             {"start.fifth", p.start_fifth}};
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (order[i].second == 0 || order[i].second != order[k].second) continue;
      complain({order[i].first, order[k].first}, "", "expected another way than that of " + order[k].first + ", or none");
    }
  }
}

void check_short_range(const Parameters& p, const Complaint& complain) {
  if (p.short_range_enter_m <= 0 || p.short_range_leave_m > p.short_range_enter_m) return;
  complain({"short_range.leave_m", "short_range.enter_m"}, number_text(p.short_range_leave_m),
           "expected more than short_range.enter_m, which is " + number_text(p.short_range_enter_m) + " m");
}

void check_times(const Scenario& scenario, const Complaint& complain) {
  const std::vector<double>& times = scenario.times_s;
  if (times.size() != scenario.ranges_m.size()) {
    complain({"times_s", "ranges_m"}, std::to_string(times.size()) + " times",
             "expected one for each of ranges_m, which are " + std::to_string(scenario.ranges_m.size()));
  }
  const auto back = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>());
  if (back != times.end())
    complain({"times_s"}, number_text(back[1]), "expected more than the time before it, " + number_text(back[0]) + " s");
  if (scenario.eclipse_s[1] < scenario.eclipse_s[0]) {
    complain({"eclipse_s"}, number_text(scenario.eclipse_s[1]),
             "expected an end that is not before the begin, " + number_text(scenario.eclipse_s[0]) + " s");
  }
}

}  // namespace

void check_parameters(const MissionParameters& parameters, const Complaint& complain) {
  check_sensor_under("sensor.", parameters, complain);
  check_points(parameters, complain);
  check_pattern(parameters, complain);
  check_duration(parameters, complain);
  check_initial(parameters, complain);
  check_order(parameters, complain);
  check_short_range(parameters, complain);
}

void check_sensor(const SensorParameters& sensor, const Complaint& complain) { check_sensor_under("", sensor, complain); }

void check_scenario(const Scenario& scenario, const MeasuredRanges& measured, const Complaint& complain) {
  if (scenario.has_profile()) check_times(scenario, complain);
  std::string known;
  for (const auto& [from_m, to_m] : measured)
    known += (known.empty() ? "" : ", or ") + number_text(from_m) + " m and " + number_text(to_m) + " m";
  for (const double range_m : scenario.ranges_m) {
    const bool good = std::any_of(measured.begin(), measured.end(), [&](const auto& m) { return range_m > m.first && range_m < m.second; });
    if (good) continue;
    complain({"ranges_m"}, number_text(range_m), "expected between sensor.range_min_m and sensor.range_max_m, which are " + known);
  }
}

void normalize_attitude(MissionParameters& parameters) {
  const double length = quaternion_length(parameters);
  parameters.initial_qx /= length;
  parameters.initial_qy /= length;
  parameters.initial_qz /= length;
  parameters.initial_qw /= length;
}

}  // namespace lasso::mdat
