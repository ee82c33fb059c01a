#include "mdat/run/relative_table.hpp"

#include <nlohmann/json.hpp>

#include "mdat/common/text.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::mdat {
namespace {

constexpr char kRelativeHeader[] =
    "relative,t_s,valid,x_m,y_m,z_m,qx,qy,qz,qw,sigma_x_mm,sigma_y_mm,sigma_z_mm,sigma_rx_deg,sigma_ry_deg,sigma_rz_deg,error_mm,error_deg,"
    "nees,filtered_x_m,filtered_y_m,filtered_z_m,filtered_qx,filtered_qy,filtered_qz,filtered_qw,vx_mps,vy_mps,vz_mps,wx_degps,wy_degps,"
    "wz_degps,filtered_error_mm,filtered_error_deg,v_error_mmps,w_error_degps\n";
constexpr double kMillimetresPerMetre = 1e3, kDegreesPerRadian = 1 / kRadPerDeg;

std::string cells(const Vec3& v, double unit) { return format(",%.9g,%.9g,%.9g", unit * v.x(), unit * v.y(), unit * v.z()); }

std::string cells(const Pose& pose) {
  return cells(pose.p, 1) + format(",%.9g,%.9g,%.9g,%.9g", pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w());
}

std::string cells(const PoseError& error) {
  return csv_cell(kMillimetresPerMetre * error.translation_m.norm()) + csv_cell(kDegreesPerRadian * error.rotation_rad);
}

// Sigmas, errors and NEES of the registration; of one that found no covariance only the errors.
std::string registration_cells(const RelativePose& pose) {
  const std::string errors = cells(pose_error(pose.T_in_of, pose.truth));
  if (pose.covariance.isZero(0.0)) return ",,,,,," + errors + ",";
  const Vec6 sigma = pose.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  return cells(Vec3(sigma.tail<3>()), kMillimetresPerMetre) + cells(Vec3(sigma.head<3>()), kDegreesPerRadian) + errors +
         csv_cell(nees(pose.T_in_of, pose.truth, pose.covariance));
}

std::string row_of(const std::string& name, const RelativePose& pose) {
  std::string text = name + format(",%.6f,%d", pose.t_s, pose.valid ? 1 : 0) + cells(pose.T_in_of) + registration_cells(pose);
  text += cells(pose.T_in_of_filtered) + cells(pose.rates.v_mps, 1) + cells(pose.rates.omega_radps, kDegreesPerRadian);
  text += cells(pose_error(pose.T_in_of_filtered, pose.truth));
  return text + csv_cell(kMillimetresPerMetre * (pose.rates.v_mps - pose.true_rates.v_mps).norm()) +
         csv_cell(kDegreesPerRadian * (pose.rates.omega_radps - pose.true_rates.omega_radps).norm()) + "\n";
}

}  // namespace

std::string relative_csv(const std::vector<RelativeRun>& runs) {
  std::string text = kRelativeHeader;
  for (const RelativeRun& run : runs) {
    for (const RelativePose& pose : run.poses) text += row_of(run.name, pose);
  }
  return text;
}

nlohmann::ordered_json relative_json(const std::vector<RelativeRun>& runs) {
  nlohmann::ordered_json json;
  for (const RelativeRun& run : runs) {
    const RelativeFigures f = relative_figures(run);
    json[run.name] = {{"poses", f.poses},
                      {"valid", f.valid},
                      {"rms_mm", f.rms_mm},
                      {"rms_deg", f.rms_deg},
                      {"nees", f.nees},
                      {"filtered_rms_mm", f.filtered_rms_mm},
                      {"filtered_rms_deg", f.filtered_rms_deg}};
  }
  return json;
}

std::string relative_text(const std::vector<RelativeRun>& runs) {
  std::string text;
  for (const RelativeRun& run : runs) {
    const RelativeFigures f = relative_figures(run);
    text += format("relative %s: %zu of %zu poses valid", run.name.c_str(), f.valid, f.poses);
    if (f.valid > 0)
      text += format(": rms %.3f mm, %.4f deg, NEES %.2f of 6; filtered %.3f mm, %.4f deg", f.rms_mm, f.rms_deg, f.nees, f.filtered_rms_mm,
                     f.filtered_rms_deg);
    text += "\n";
  }
  return text;
}

}  // namespace lasso::mdat
