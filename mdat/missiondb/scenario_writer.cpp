#include "mdat/missiondb/scenario_writer.hpp"

#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "mdat/missiondb/sections.hpp"

namespace lasso::mdat {
namespace {

using Lines = std::map<std::string, std::vector<double>>;

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

void write_begin(std::ostream& out, const std::string& name, const std::string& meaning) {
  out << "\n[scenario." << name << "]  # " << meaning << "\n";
}

// Of the keys that scenarios have, those in `lines`, or all where `presets` fill the others.
void write_lines(std::ostream& out, const Lines& lines, bool presets) {
  for (const ValueRow& row : scenario_rows()) {
    const auto line = lines.find(row.key);
    if (line != lines.end()) write_row(out, row, line->second);
    if (line == lines.end() && presets && !row.preset.empty()) write_row(out, row, row.preset);
  }
}

std::vector<double> times(double range_m, const std::vector<double>& factors) {
  std::vector<double> ranges;
  for (const double factor : factors) ranges.push_back(rounded(factor * range_m));
  return ranges;
}

// Of a track that starts from the true pose of one frame before.
void write_start(std::ostream& out, double range_m) {
  out << "override.tracking.start_sigma_m = " << number_text(rounded(0.005 * range_m))
      << "  # the track starts from the pose of one frame before\noverride.tracking.start_sigma_deg = 2\n";
}

void write_paper(std::ostream& out, const std::vector<double>& center, double range_m) {
  write_begin(out, "paper", "the target turns between scans and stands still in each, at several ranges");
  write_lines(out,
              {{"ranges_m", times(range_m, {1, 1.5, 2})}, {"step_deg", {1}}, {"variants", {1}}, {"offset_m", {0, 0}}, {"center_m", center}},
              true);
  out << "override.estimation.deskew = false  # the target stands still in each scan\n";
  write_start(out, range_m);
}

void write_spin(std::ostream& out, const std::vector<double>& center, double range_m) {
  write_begin(out, "spin", "the target turns and drifts all the time, at 3 deg/s");
  write_lines(out,
              {{"ranges_m", times(range_m, {1.3})},
               {"frames", {200}},
               {"tilt_deg", {15}},
               {"boresight_deg", {5}},
               {"offset_m", {0, 0}},
               {"center_m", center},
               {"spin_degps", {2, -1, 2}},
               {"drift_mps", {rounded(0.001 * range_m), 0, 0}},
               {"seed", {2}}},
              false);
  write_start(out, range_m);
}

void write_search(std::ostream& out, const std::vector<double>& center, double range_m) {
  write_begin(out, "search", "no pose to start from: the bearing, then a search, then the track");
  write_lines(out,
              {{"ranges_m", times(range_m, {1.1, 1.6})},
               {"frames", {150}},
               {"tilt_deg", {35}},
               {"boresight_deg", {50}},
               {"offset_m", {0, 0}},
               {"center_m", center},
               {"spin_degps", {1, -0.5, 1}},
               {"prior", {0}},
               {"seed", {3}}},
              false);
}

void write_approach(std::ostream& out, const std::vector<double>& center, double range_m) {
  write_begin(out, "approach", "from afar to near through all modes; a navigation system helps where no search has found the target");
  write_lines(out,
              {{"ranges_m", times(range_m, {2, 2, 1.1, 1.1})},
               {"times_s", {0, 40, 100, 110}},
               {"frames", {600}},
               {"tilt_deg", {35}},
               {"boresight_deg", {50}},
               {"offset_m", {0, 0}},
               {"center_m", center},
               {"spin_degps", {0.2, 0.1, 0}},
               {"autonomous", {1}},
               {"navigation_from_s", {30}},
               {"navigation_sigma_m", {rounded(0.01 * range_m)}},
               {"seed", {4}}},
              false);
}

}  // namespace

double rounded(double value) {
  if (value == 0) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::fabs(value))) - 1);
  std::ostringstream text;
  text.precision(3);
  text << std::round(value / unit) * unit;
  return std::stod(text.str());
}

// Without the last digits that adding and subtracting made up.
std::vector<double> list_of(const Eigen::Vector3d& v) {
  std::vector<double> list;
  for (const double value : v) {
    std::ostringstream text;
    text.precision(9);
    text << value + 0.0;
    list.push_back(std::stod(text.str()));
  }
  return list;
}

void write_row(std::ostream& out, const ValueRow& row, const std::vector<double>& value) {
  const std::string line = row.key.substr(row.key.rfind('.') + 1) + " = " + toml_text(row, value);
  out << line << std::string(line.size() < 36 ? 36 - line.size() : 0, ' ') << comment_of(row) << '\n';
}

void write_scenarios(std::ostream& out, const MeshSize& size, double range_m) {
  const std::vector<double> center = list_of(size.center);
  write_paper(out, center, range_m);
  write_spin(out, center, range_m);
  write_search(out, center, range_m);
  write_approach(out, center, range_m);
}

}  // namespace lasso::mdat
