#include "fsw/mission/mission_fit.hpp"

#include "fsw/mission/number_fit.hpp"

namespace lasso {
namespace {

// The whole's scans and each part's end within the period.
bool scans_fit(const Mission& mission, const Parts& parts) {
  const double period_s = mission.parameters.period_s;
  bool fit = mission.parameters.duration_s <= period_s;
  for (const Part& part : parts) fit = fit && part.mission.parameters.duration_s <= period_s;
  return fit;
}

const char* fault_of(const SensorParameters& sensor) {
  if (!(sensor.range_min_m < sensor.range_max_m)) return "sensor.range_min_m is not below sensor.range_max_m";
  return sensor.use_from_m < sensor.use_to_m ? nullptr : "sensor.use_from_m is not below sensor.use_to_m";
}

// Each sensor looks at each part, too.
const char* misfit_of(const SensorParameters& sensor, const Parts& parts) {
  for (const Part& part : parts) {
    const Misfit misfit = misfit_of(sensor, part.mission.radius_m);
    if (misfit.what != nullptr) return misfit.what;
  }
  return nullptr;
}

}  // namespace

const char* fault_of(const Mission& mission, const Parts& parts, std::size_t sensors) {
  const MissionParameters& p = mission.parameters;
  if (mission.sensors.size() > sensors) return "the mission has more sensors than are connected";
  for (const SensorParameters& sensor : mission.sensors) {
    const char* fault = fault_of(sensor);
    if (fault == nullptr) fault = misfit_of(sensor, parts);
    if (fault != nullptr) return fault;
  }
  if (!scans_fit(mission, parts)) return "scan.duration_s exceeds filter.period_s";
  if (p.short_range_enter_m > 0 && !(p.short_range_leave_m > p.short_range_enter_m)) {
    return "short_range.leave_m is not above short_range.enter_m";
  }
  return nullptr;
}

const char* fault_of_change(const Mission& present, const Mission& next) {
  // The executive keeps its frame.
  return next.parameters.period_s == present.parameters.period_s ? nullptr : "filter.period_s is not that of the active image";
}

bool keeps_track(const Mission& present, const Parts& parts, const Mission& next, const Parts& next_parts) {
  return present.id == next.id && present.sensors.size() == next.sensors.size() && parts.size() == next_parts.size();
}

}  // namespace lasso
