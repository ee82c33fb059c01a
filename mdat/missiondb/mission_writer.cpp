#include "mdat/missiondb/mission_writer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "mdat/missiondb/flash_rows.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/scenario_writer.hpp"
#include "mdat/missiondb/sections.hpp"

namespace lasso::mdat {
namespace {

constexpr double kReferenceSize_m = 1.33;   // the tenth-scale Hubble's length, for which the presets were chosen
constexpr double kFieldShare = 0.9;         // of the field of view that the target's circumscribed sphere fills at the initial range
constexpr double kNearestSurface_m = 0.45;  // a laser camera by the preset optics sees nothing nearer than 0.4 m
constexpr double kLidarAngle_rad = 1e-4;    // on which side of a contour a beam that widens by 0.25 mrad passed

using Values = std::map<std::string, double>;  // by key, in the row's unit

// Lengths of the presets grow with the target; so does the noise, as a larger target is met with a sensor for larger ranges.
Values sized_values(const NewMission& mission) {
  const MeshSize& size = mission.size;
  Values values;
  for (const char* key :
       {"estimation.gate_first_m", "estimation.stop_translation_m", "estimation.silhouette_sigma_m", "estimation.silhouette_band_m",
        "estimation.edge_gap_min_m", "estimation.edge_depth_m", "estimation.probe_step_m", "filter.acceleration_mps2",
        "filter.initial_rate_mps", "bearing.rate_mps", "tracking.start_sigma_m", "tracking.sigma_position_max_m"}) {
    values[key] = sized_preset(key, size.largest_m);
  }
  values["estimation.surface_sigma_m"] = mission.surface_sigma_m;
  const double range_m = initial_range_m(size);
  const RangeNoise noise = guessed_noise(size, mission.sensor);
  values["sensor.sigma0_m"] = noise.sigma0_m;
  values["sensor.sigma_k_per_m"] = noise.sigma_k_per_m;
  if (noise.kind == SensorKind::kTimeOfFlight) values["sensor.sigma_angle_rad"] = kLidarAngle_rad;
  if (noise.kind == SensorKind::kFlashLidar) values["sensor.sigma_angle_rad"] = preset_of(noise.kind, "sensor.sigma_angle_rad", 0);
  values["sensor.range_min_m"] = std::max(0.0, (range_m - size.radius_m) / 4);
  values["sensor.range_max_m"] = 4 * (range_m + size.radius_m);
  for (auto& [key, value] : values) {
    const ValueRow& row = *find_row(flight_rows(), key);
    value = std::clamp(rounded(value), row.minimum, row.maximum);
  }
  values.insert({{"start.fifth", 5}, {"tracking.recover", 1}});  // or the ground would mend wrong starts and lost tracks
  values["tracking.initial.present"] = 1;
  const std::vector<double> center = list_of(size.center);
  values["tracking.initial.x_m"] = 0.0 - center[0];
  values["tracking.initial.y_m"] = 0.0 - center[1];
  values["tracking.initial.z_m"] = list_of({range_m - center[2], 0, 0})[0];
  return values;
}

std::string section_of(const std::string& key) { return key.substr(0, key.rfind('.')); }

void write_kind(std::ostream& out, SensorKind kind) {
  const char* texts[] = {"kind = \"laser_camera\"  # or \"time_of_flight\", a LIDAR",
                         "kind = \"time_of_flight\"  # a LIDAR; or \"laser_camera\"",
                         "kind = \"flash_lidar\"  # or \"time_of_flight\", a LIDAR that scans"};
  out << texts[static_cast<int>(kind)] << ": then delete the noise and ranges below, whose presets are that kind's\n";
  if (kind != SensorKind::kFlashLidar) return;
  for (const ValueRow& row : flash_rows()) write_row(out, row, row.preset);
}

void write_flight_parameters(std::ostream& out, const Values& values, SensorKind kind) {
  std::string section;
  for (const ValueRow& row : flight_rows()) {
    if (section_of(row.key) != section) {
      section = section_of(row.key);
      out << "\n[" << section << "]\n";
      if (section == "sensor") write_kind(out, kind);
    }
    const auto value = values.find(row.key);
    write_row(out, row, value == values.end() ? row.preset : std::vector<double>{value->second});
  }
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

void write_head(std::ostream& out, const NewMission& mission) {
  out << "# A mission for " << mission.name
      << ". Every key is listed with its meaning, unit and range; those at their presets may be deleted.\n";
  for (const std::string& remark : mission.remarks) out << "# " << remark << '\n';
  out << "\n[mission]\nid = 1                                # number of the mission in telemetry\n"
      << "version = 1                           # counts up with every change that flies\nname = " << quoted(mission.name)
      << "\n\n[target]\n"
      << (mission.parametric ? "model = " : "mesh = ") << quoted(mission.path) << "\nsha256 = \"" << mission.sha256 << "\"\n";
  const ValueRow& crease = *find_row(mission_rows(), "target.crease_angle_deg");
  write_row(out, *find_row(mission_rows(), "target.scale"), {mission.scale});
  write_row(out, *find_row(mission_rows(), "target.origin_m"), list_of(mission.origin_m));
  write_row(out, crease, crease.preset);
  write_row(out, *find_row(mission_rows(), "target.cell_size_m"), {mission.cell_size_m});
}

// The half of the target at low x.
std::string half_box(const MeshSize& size) {
  std::string text;
  for (const double side : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      const double reach = axis == 0 && side > 0 ? 0 : 0.55 * side * size.largest_m;
      text += (text.empty() ? "[" : ", ") + number_text(rounded(size.center[axis] + reach));
    }
  }
  return text + "]";
}

// What most missions have no need of, as comments that need but be uncommented.
void write_examples(std::ostream& out, const MeshSize& size, double range_m) {
  const std::string turn_m = number_text(rounded(range_m / 2));
  out << "\n# A further sensor takes the scans while the target's origin is within its band. [sensor] then has one, too; where bands "
         "overlap the\n"
      << "# sensor in use stays.\n# [further_sensor.near]\n# kind = \"laser_camera\"\n# use_from_m = 0\n# use_to_m = " << turn_m
      << "\n\n# A part of the target, looked at from close by; [short_range] says from where on (enter_m, leave_m).\n# [part.front]\n# "
         "box_m = "
      << half_box(size) << "  # what of the target lies in it\n# range_m = [0.01, " << turn_m
      << "]  # of the part's centre from the sensor\n# view = [-1, 0, 0]  # towards the sensors that see it\n# cone_deg = 75\n";
}

// The chaser comes along the x axis to the target's middle, which turns slowly.
void write_scene_example(std::ostream& out, const MeshSize& size, double range_m) {
  const std::string center = "[" + number_text(rounded(size.center[0])) + ", " + number_text(rounded(size.center[1])) + ", " +
                             number_text(rounded(size.center[2])) + "]";
  const auto place = [](double away_m) { return "position_m = [" + number_text(rounded(-away_m)) + ", 0, 0]}"; };
  out << "\n# A scene: nodes that move, in place of ranges_m, and poses between named frames, in telemetry, too (docs/scenes.md). With "
         "[orbit] it\n"
         "# has the Sun's light, the Earth's shadow and the Hill frame.\n"
      << "# [motion.turning]\n# kind = \"rates\"\n# pivot_m = " << center
      << "\n# spin_degps = [0.3, 0.1, 0.5]\n# [motion.closing]\n# kind = \"waypoints\"\n# at = [{time_s = 0, " << place(range_m)
      << ", {time_s = 120, " << place(0.8 * range_m) << "]\n"
      << "# [node.craft]\n# target = true\n# motion = \"turning\"\n# [node.middle]\n# parent = \"craft\"\n# position_m = " << center
      << "\n# [node.chaser]\n# motion = \"closing\"\n# towards = \"middle\"\n# [node.head]\n# parent = \"chaser\"\n# sensor = true\n"
      << "# [relative.docking]  # of this frame in that one\n# of = \"middle\"\n# in = \"chaser\"\n# [scenario.scene]\n# frames = 600\n";
}

}  // namespace

double sized_preset(const std::string& key, double largest_m) {
  return find_row(flight_rows(), key)->preset[0] * largest_m / kReferenceSize_m;
}

double filled_range_m(const MeshSize& size) {
  const ValueRow& field = *find_row(flight_rows(), "sensor.fov_half_x_deg");
  return size.radius_m / std::sin(kFieldShare * field.preset[0] * field.to_si) * 1.01;
}

double initial_range_m(const MeshSize& size) { return rounded(std::max(kNearestSurface_m + 1.1 * size.radius_m, filled_range_m(size))); }

RangeNoise guessed_noise(const MeshSize& size, std::optional<SensorKind> sensor) {
  const auto preset = [](const std::string& key) { return find_row(flight_rows(), key)->preset[0]; };
  const auto of_lidar = [&](const std::string& key) { return preset_of(SensorKind::kTimeOfFlight, key, preset(key)); };
  if (sensor == SensorKind::kFlashLidar) {
    const auto of_flash = [&](const std::string& key) { return preset_of(SensorKind::kFlashLidar, key, preset(key)); };
    return {SensorKind::kFlashLidar, of_flash("sensor.sigma0_m"), of_flash("sensor.sigma_k_per_m")};
  }
  const bool far = 2 * initial_range_m(size) > preset("sensor.range_max_m");
  if (sensor.value_or(far ? SensorKind::kTimeOfFlight : SensorKind::kLaserCamera) == SensorKind::kTimeOfFlight)
    return {SensorKind::kTimeOfFlight, of_lidar("sensor.sigma0_m"), of_lidar("sensor.sigma_k_per_m")};
  const double nearer = filled_range_m(size) / initial_range_m(size);  // less than 1 where the target is small
  return {SensorKind::kLaserCamera, sized_preset("sensor.sigma0_m", size.largest_m),
          std::max(kCameraCounts_per_m, nearer * nearer * preset("sensor.sigma_k_per_m") * kReferenceSize_m / size.largest_m)};
}

std::string new_mission_text(const NewMission& mission) {
  std::ostringstream out;
  write_head(out, mission);
  out << "\n# [sensor] describes your sensor; the noise written here is a guess from the target's size: replace it by your sensor's.\n";
  write_flight_parameters(out, sized_values(mission), guessed_noise(mission.size, mission.sensor).kind);
  write_scenarios(out, mission.size, initial_range_m(mission.size));
  write_examples(out, mission.size, initial_range_m(mission.size));
  write_scene_example(out, mission.size, initial_range_m(mission.size));
  return out.str();
}

}  // namespace lasso::mdat
