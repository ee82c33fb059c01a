#include "mdat/missiondb/laser_safety.hpp"

#include <algorithm>
#include <iterator>

namespace lasso::mdat {
namespace {

constexpr std::size_t kLaserPrefix = sizeof("sensor.") - 1;
constexpr const char* kClasses[] = {"not_stated", "1", "1C", "1M", "2", "2M", "3R", "3B", "4"};
constexpr double kFarthestHazard_m = 1e6;
constexpr double kMostInhibits = 9;

struct LaserField {
  ValueRow row;
  double LaserSafety::*member;
};

ValueRow class_row() {
  ValueRow row = number_row("sensor.laser_class", "1", ValueKind::kChoice, 1, 0, static_cast<double>(std::size(kClasses) - 1), 0,
                            "class of the laser product by IEC 60825-1, as its maker states it");
  row.choices = {std::begin(kClasses), std::end(kClasses)};
  return row;
}

const std::vector<LaserField>& laser_fields() {
  using L = LaserSafety;
  static const std::vector<LaserField> fields = {
      {class_row(), &L::laser_class},
      {number_row("sensor.laser_hazard_distance_m", "m", ValueKind::kReal, 1, 0, kFarthestHazard_m, 0,
                  "nominal ocular hazard distance by IEC 60825-1, as its maker states it; beyond it the beam is below the limits for eyes"),
       &L::hazard_distance_m},
      {number_row("sensor.laser_inhibits", "1", ValueKind::kInteger, 1, 0, kMostInhibits, 0,
                  "independent inhibits of the laser in hardware, besides the component's permission (with its driver's, on one "
                  "processor: one inhibit) and the head's own time-out (another one)"),
       &L::inhibits},
  };
  return fields;
}

}  // namespace

const std::vector<ValueRow>& laser_safety_rows() {
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> result;
    for (const LaserField& field : laser_fields()) result.push_back(field.row);
    return result;
  }();
  return rows;
}

bool is_laser_safety(const std::string& key) {
  const std::string name = key.substr(key.rfind('.') + 1);
  const auto& rows = laser_safety_rows();
  return std::any_of(rows.begin(), rows.end(), [&](const ValueRow& row) { return row.key.substr(kLaserPrefix) == name; });
}

LaserSafety read_laser_safety(const FoundValues& found, const std::string& found_prefix, SensorKind kind, const std::string& prefix,
                              ProblemList& problems) {
  LaserSafety laser;
  const auto value_of = [&](const LaserField& field) { return found.find(found_prefix + field.row.key.substr(kLaserPrefix)); };
  for (const LaserField& field : laser_fields()) {
    const auto value = value_of(field);
    if (value == found.end()) continue;
    laser.*field.member = value->second.numbers.at(0);
    laser.stated = true;
    if (kind == SensorKind::kStereo)
      problems.add(value->second.origin, prefix + field.row.key.substr(kLaserPrefix), value_text(field.row, value->second.numbers),
                   "has no effect in a stereo sensor, which has no laser: leave it out");
  }
  const auto distance = value_of(laser_fields()[1]);
  if (distance != found.end() && laser.laser_class == 0)
    problems.add(distance->second.origin, prefix + "laser_hazard_distance_m", number_text(laser.hazard_distance_m),
                 "is of a class that is not stated: state " + prefix + "laser_class, too");
  return laser;
}

double laser_safety_value(const LaserSafety& laser, const ValueRow& row) {
  for (const LaserField& field : laser_fields()) {
    if (field.row.key == row.key) return laser.*field.member;
  }
  return 0;
}

}  // namespace lasso::mdat
