#include "mdat/missiondb/mission_writer.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/model_file.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/sha256.hpp"

namespace lasso::mdat {
namespace {

constexpr double kReferenceSize_m = 1.33;  // the tenth-scale Hubble's length, for which the presets were chosen
constexpr double kFieldShare = 0.9;        // of the field of view that the target's circumscribed sphere fills at the initial range

struct Size {
  Eigen::Vector3d center;
  double radius = 0;   // of the sphere about the box's middle that holds all vertices
  double largest = 0;  // side of the bounding box
};

Size size_of(const Mesh& mesh) {
  Eigen::Vector3d low = mesh.vertices.at(0), high = low;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  Size size;
  size.center = 0.5 * (low + high);
  size.largest = (high - low).maxCoeff();
  for (const Eigen::Vector3d& v : mesh.vertices) size.radius = std::max(size.radius, (v - size.center).norm());
  return size;
}

// Two significant digits: a person will read and change it.
double rounded(double value) {
  if (value == 0) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::fabs(value))) - 1);
  std::ostringstream text;
  text.precision(3);
  text << std::round(value / unit) * unit;
  return std::stod(text.str());
}

using Values = std::map<std::string, double>;  // by key, in the row's unit

double initial_range(const Size& size) {
  const double half_field =
      find_row(flight_rows(), "sensor.fov_half_x_deg")->preset[0] * find_row(flight_rows(), "sensor.fov_half_x_deg")->to_si;
  return rounded(size.radius / std::sin(kFieldShare * half_field) * 1.01);
}

// Lengths of the presets grow with the target; so does the noise, as a larger target is met with a sensor for larger ranges.
Values sized_values(const Size& size) {
  Values values;
  const double ratio = size.largest / kReferenceSize_m;
  for (const char* key : {"sensor.sigma0_m", "estimation.gate_first_m", "estimation.stop_translation_m", "estimation.silhouette_sigma_m",
                          "estimation.silhouette_band_m", "estimation.edge_gap_min_m", "estimation.edge_depth_m", "estimation.probe_step_m",
                          "estimation.surface_sigma_m", "filter.acceleration_mps2", "filter.initial_rate_mps", "tracking.start_sigma_m",
                          "tracking.sigma_position_max_m"}) {
    values[key] = find_row(flight_rows(), key)->preset[0] * ratio;
  }
  values["sensor.sigma_k_per_m"] = find_row(flight_rows(), "sensor.sigma_k_per_m")->preset[0] / ratio;
  const double range_m = initial_range(size);
  values["sensor.range_min_m"] = std::max(0.0, (range_m - size.radius) / 4);
  values["sensor.range_max_m"] = 4 * (range_m + size.radius);
  for (auto& [key, value] : values) {
    const ValueRow& row = *find_row(flight_rows(), key);
    value = std::clamp(rounded(value), row.minimum, row.maximum);
  }
  values.insert({{"start.fifth", 5}, {"tracking.recover", 1}});  // or the ground would mend wrong starts and lost tracks
  values["tracking.initial.present"] = 1;
  values["tracking.initial.x_m"] = rounded(-size.center.x());
  values["tracking.initial.y_m"] = rounded(-size.center.y());
  values["tracking.initial.z_m"] = rounded(range_m - size.center.z());
  return values;
}

std::string comment_of(const ValueRow& row) {
  std::string text = "  # ";
  if (!row.unit.empty() && row.unit != "1") text += "[" + row.unit + "] ";
  text += row.meaning;
  if (row.kind == ValueKind::kReal || row.kind == ValueKind::kInteger || row.kind == ValueKind::kReals) {
    text += "; " + number_text(row.minimum) + " to " + number_text(row.maximum);
  }
  if (row.kind == ValueKind::kChoice) text += "; " + expectation(row).substr(9);
  return text;
}

void write_row(std::ostream& out, const ValueRow& row, const std::vector<double>& value) {
  const std::string line = row.key.substr(row.key.rfind('.') + 1) + " = " + toml_text(row, value);
  out << line << std::string(line.size() < 36 ? 36 - line.size() : 0, ' ') << comment_of(row) << '\n';
}

std::string section_of(const std::string& key) { return key.substr(0, key.rfind('.')); }

void write_flight_parameters(std::ostream& out, const Values& values) {
  std::string section;
  for (const ValueRow& row : flight_rows()) {
    if (section_of(row.key) != section) {
      section = section_of(row.key);
      out << "\n[" << section << "]\n";
      if (section == "sensor")
        out << "kind = \"laser_camera\"  # or \"time_of_flight\", a LIDAR: then delete the noise and ranges below, whose presets are that "
               "kind's\n";
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

void write_head(std::ostream& out, const std::string& name, const std::string& path, const std::string& digest, bool parametric,
                double scale, double cell_size_m) {
  out << "# A mission for " << name << ". Every key is listed with its meaning, unit and range; those at their presets may be deleted.\n\n"
      << "[mission]\nid = 1                                # number of the mission in telemetry\n"
      << "version = 1                           # counts up with every change that flies\nname = " << quoted(name) << "\n\n[target]\n"
      << (parametric ? "model = " : "mesh = ") << quoted(path) << "\nsha256 = \"" << digest << "\"\n";
  write_row(out, *find_row(mission_rows(), "target.scale"), {scale});
  write_row(out, *find_row(mission_rows(), "target.crease_angle_deg"), find_row(mission_rows(), "target.crease_angle_deg")->preset);
  write_row(out, *find_row(mission_rows(), "target.cell_size_m"), {cell_size_m});
}

void write_scenario(std::ostream& out, double range_m) {
  out << "\n[scenario.paper]  # the target turns between scans and stands still in each, at several ranges\n";
  const Values values{{"tilt_deg", 15}, {"frames", 360}};
  for (const ValueRow& row : scenario_rows()) {
    if (row.key == "kind") out << "kind = \"paper\"\n";
    if (row.key == "ranges_m") write_row(out, row, {range_m, rounded(1.5 * range_m), rounded(2 * range_m)});
    if (row.key == "offset_m") write_row(out, row, {0, 0});
    if (row.key != "offset_m" && !row.preset.empty()) write_row(out, row, row.preset);
  }
  out << "override.estimation.deskew = false\n";
  out << "override.start.check = false  # the start is right\n";
  out << "override.tracking.start_sigma_m = " << rounded(0.005 * range_m) << "  # the track starts from the pose of one frame before\n";
  out << "override.tracking.start_sigma_deg = 2\n";
}

// The half of the target at low x.
std::string half_box(const Size& size) {
  std::string text;
  for (const double side : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      const double reach = axis == 0 && side > 0 ? 0 : 0.55 * side * size.largest;
      text += (text.empty() ? "[" : ", ") + number_text(rounded(size.center[axis] + reach));
    }
  }
  return text + "]";
}

// What most missions have no need of, as comments that need but be uncommented.
void write_examples(std::ostream& out, const Size& size, double range_m) {
  const std::string turn_m = number_text(rounded(range_m / 2));
  out << "\n# A further sensor takes the scans while the target's origin is within its band. [sensor] then has one, too; where bands "
         "overlap the\n"
      << "# sensor in use stays.\n# [further_sensor.near]\n# kind = \"laser_camera\"\n# use_from_m = 0\n# use_to_m = " << turn_m
      << "\n\n# A part of the target, looked at from close by; [short_range] says from where on (enter_m, leave_m).\n# [part.front]\n# "
         "box_m = "
      << half_box(size) << "  # what of the target lies in it\n# range_m = [0.01, " << turn_m
      << "]  # of the part's centre from the sensor\n# view = [-1, 0, 0]  # towards the sensors that see it\n# cone_deg = 75\n";
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw MissionError({file.string(), 0, 0, "", "", reason});
}

Mesh read_model(const std::filesystem::path& model, double scale) {
  const ValueRow& row = *find_row(mission_rows(), "target.scale");
  if (!(scale >= row.minimum && scale <= row.maximum)) {
    throw MissionError({model.string(), 0, 0, "scale", number_text(scale), expectation(row) + " (" + row.meaning + ")"});
  }
  try {
    if (model.extension() != ".toml") return import_mesh(model, scale);
    Mesh mesh = build_model(model, {});
    for (Eigen::Vector3d& v : mesh.vertices) v *= scale;
    check_extent(mesh);
    return mesh;
  } catch (const MeshError& error) {
    fail(model, error.what());
  }
}

}  // namespace

std::string new_mission_text(const std::filesystem::path& model, double scale, const std::string& model_path) {
  const Size size = size_of(read_model(model, scale));
  const ValueRow& cell = *find_row(mission_rows(), "target.cell_size_m");
  const double cell_size_m = std::clamp(rounded(cell.preset[0] * size.largest / kReferenceSize_m), cell.minimum, cell.maximum);
  std::ostringstream out;
  write_head(out, model.stem().string(), model_path, sha256_of(read_file(model)), model.extension() == ".toml", scale, cell_size_m);
  out << "\n# [sensor] describes your sensor; the noise written here grows with the target's size: replace it by your sensor's.\n";
  write_flight_parameters(out, sized_values(size));
  write_scenario(out, initial_range(size));
  write_examples(out, size, initial_range(size));
  return out.str();
}

void write_new_mission(const std::filesystem::path& model, double scale, const std::filesystem::path& out) {
  const std::filesystem::path folder = std::filesystem::absolute(out).parent_path();
  std::error_code error;
  const std::filesystem::path relative = std::filesystem::relative(model, folder, error);
  const std::string path = (error || relative.empty() ? std::filesystem::absolute(model) : relative).generic_string();
  const std::string text = new_mission_text(model, scale, path);
  const std::filesystem::path part = out.string() + ".part";
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    std::filesystem::remove(part, error);
    fail(out, "cannot be written: does the folder exist, and may you write there?");
  }
  std::filesystem::rename(part, out, error);
  if (error) {
    std::filesystem::remove(part);
    fail(out, "cannot be written: " + error.message());
  }
}

}  // namespace lasso::mdat
