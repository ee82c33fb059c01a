#include "mdat/run/flight_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "fsw/link/space_packet.hpp"
#include "fsw/mode/modes.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/run/case.hpp"
#include "mdat/run/verdict.hpp"

namespace lasso::mdat {
namespace {

// Over valid poses.
struct FlightSums {
  double m2 = 0, rad2 = 0, nees = 0, residual_m2 = 0;
  std::size_t wrong = 0;
  PoseError worst;
};

void add_valid(const PoseTelemetry& pose, const TruthAt& truth, FlightSums& sums) {
  sums.residual_m2 += static_cast<double>(pose.rms_m) * static_cast<double>(pose.rms_m);
  if (!truth) return;
  const Pose T_sensor_true = truth(pose.t_measurement_us);
  const PoseError error = pose_error(registration_pose(pose), T_sensor_true);
  sums.m2 += error.translation_m.squaredNorm();
  sums.rad2 += error.rotation_rad * error.rotation_rad;
  sums.nees += nees(registration_pose(pose), T_sensor_true, registration_covariance(pose));
  if (judge_valid(pose, T_sensor_true) == PoseVerdict::kWrong) ++sums.wrong;
  if (error.translation_m.norm() > sums.worst.translation_m.norm()) sums.worst = error;
}

double root_of_mean(double sum, std::size_t count) { return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0; }

// What is no number is the same as another one that is none.
template <class T, std::size_t N>
bool same_values(const T (&a)[N], const T (&b)[N]) {
  return std::equal(a, a + N, b, [](T x, T y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

bool say_the_same(const PoseTelemetry& a, const PoseTelemetry& b) {
  return a.valid == b.valid && a.reason == b.reason && a.mode == b.mode && same_values(a.q_sensor_target, b.q_sensor_target) &&
         same_values(a.p_sensor_target_m, b.p_sensor_target_m) && same_values(a.covariance, b.covariance) &&
         same_values(a.filter_q_sensor_target, b.filter_q_sensor_target) &&
         same_values(a.filter_p_sensor_target_m, b.filter_p_sensor_target_m) && same_values(a.filter_omega_radps, b.filter_omega_radps) &&
         same_values(a.filter_v_mps, b.filter_v_mps);
}

std::string flight_figure(const char* format, std::optional<double> value) {
  char text[40] = "-";
  if (value) (void)std::snprintf(text, sizeof text, format, *value);
  return text;
}

std::optional<double> whole_figure(std::optional<std::size_t> count) {
  return count ? std::optional<double>(static_cast<double>(*count)) : std::nullopt;
}

struct FigureRow {
  const char* title;
  const char* format;
  std::optional<double> (*value)(const FlightFigures& figures);
};
constexpr FigureRow kFigureRows[] = {
    {"poses told", "%.0f", [](const FlightFigures& f) { return whole_figure(f.poses); }},
    {"valid", "%.0f", [](const FlightFigures& f) { return whole_figure(f.valid); }},
    {"wrong", "%.0f", [](const FlightFigures& f) { return whole_figure(f.wrong); }},
    {"rms, mm", "%.3f", [](const FlightFigures& f) { return f.rms_mm; }},
    {"rms, deg", "%.4f", [](const FlightFigures& f) { return f.rms_deg; }},
    {"worst, mm", "%.2f",
     [](const FlightFigures& f) { return f.worst ? std::optional<double>(1e3 * f.worst->translation_m.norm()) : std::nullopt; }},
    {"NEES (6 is honest)", "%.2f", [](const FlightFigures& f) { return f.nees; }},
    {"rms of residuals, mm", "%.3f", [](const FlightFigures& f) { return std::optional<double>(f.residual_mm); }},
    {"mode changes", "%.0f", [](const FlightFigures& f) { return whole_figure(f.mode_changes); }}};

std::string table_line(const std::string& title, const std::string& a, const std::string& b) {
  char line[160];
  (void)std::snprintf(line, sizeof line, "%-22.40s %12.40s %12.40s\n", title.c_str(), a.c_str(), b.c_str());
  return line;
}

}  // namespace

std::vector<PoseTelemetry> poses_in(ConstBytes telemetry) {
  std::vector<PoseTelemetry> poses;
  while (const std::size_t size = packet_size(telemetry)) {
    const ConstBytes packet = telemetry.first(std::min(size, telemetry.size()));
    PacketHeader header;
    PoseTelemetry pose;
    const PacketFault fault = decode_pose(packet, header, pose, read_primary_header(packet).apid);
    if (fault != PacketFault::kNone && fault != PacketFault::kUnknown)
      throw RunError("telemetry cannot be decoded: " + std::string(to_string(fault)));
    if (fault == PacketFault::kNone) poses.push_back(pose);
    telemetry = telemetry.subspan(packet.size(), telemetry.size() - packet.size());
  }
  return poses;
}

FlightFigures flight_figures(const std::vector<PoseTelemetry>& poses, const TruthAt& truth) {
  FlightFigures figures;
  FlightSums sums;
  for (const PoseTelemetry& pose : poses) {
    ++figures.poses;
    figures.mode_changes += pose.changes;
    if (pose.valid == 0) continue;
    ++figures.valid;
    add_valid(pose, truth, sums);
  }
  figures.residual_mm = 1e3 * root_of_mean(sums.residual_m2, figures.valid);
  if (!truth) return figures;
  figures.wrong = sums.wrong;
  if (figures.valid == 0) return figures;
  figures.worst = sums.worst;
  figures.rms_mm = 1e3 * root_of_mean(sums.m2, figures.valid);
  figures.rms_deg = root_of_mean(sums.rad2, figures.valid) / kRadPerDeg;
  figures.nees = sums.nees / static_cast<double>(figures.valid);
  return figures;
}

std::optional<TimeUs> first_difference(const std::vector<PoseTelemetry>& a, const std::vector<PoseTelemetry>& b) {
  const std::size_t both = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (a[i].t_measurement_us != b[i].t_measurement_us) return std::min(a[i].t_measurement_us, b[i].t_measurement_us);
    if (!say_the_same(a[i], b[i])) return a[i].t_measurement_us;
  }
  if (a.size() == b.size()) return std::nullopt;
  return (a.size() > both ? a : b)[both].t_measurement_us;
}

std::string side_by_side(const std::string& name_a, const FlightFigures& a, const std::string& name_b, const FlightFigures& b) {
  std::string text = table_line("", name_a, name_b);
  for (const FigureRow& row : kFigureRows)
    text += table_line(row.title, flight_figure(row.format, row.value(a)), flight_figure(row.format, row.value(b)));
  return text;
}

}  // namespace lasso::mdat
