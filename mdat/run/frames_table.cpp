#include "mdat/run/frames_table.hpp"

#include "fsw/mode/modes.hpp"
#include "fsw/pose/scan/result.hpp"
#include "mdat/common/text.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMm = 1e3, kDeg = 1 / kRadPerDeg;

constexpr char kColumns[] =
    "table,variant,run,frame,t_s,range_m,mode,reported,valid,reason,wrong,misleading,lost,x_mm,y_mm,z_mm,yaw_deg,pitch_deg,roll_deg,error_"
    "mm,error_"
    "deg,"
    "sigma_mm,sigma_deg,nees,level_mm,level_deg,filtered_mm,filtered_deg,omega_error_degps,v_error_mmps,returns,inliers,sensor,part,"
    "estimate_us\n";

std::string error_cells(const FrameError& frame) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += csv_cell(kMm * frame.registration.translation_m[i]);
  for (int i = 0; i < 3; ++i) text += csv_cell(kDeg * frame.registration.yaw_pitch_roll[i]);
  for (const double value :
       {kMm * frame.registration.translation_m.norm(), kDeg * frame.registration.rotation_rad, kMm * frame.sigma_m, kDeg * frame.sigma_rad,
        frame.nees, kMm * frame.level.position_m, kDeg * frame.level.attitude_rad, kMm * frame.filtered.translation_m.norm(),
        kDeg * frame.filtered.rotation_rad, kDeg * frame.omega_error_radps, kMm * frame.v_error_mps})
    text += csv_cell(value);
  return text;
}

std::string row(const SimulationResult& result, const FrameError& frame) {
  std::string text = format("%u,%.6g,%.6g,", frame.frame, frame.t_s, frame.range_m);
  const bool misleading = frame.misleads_about_position() || frame.misleads_about_attitude();
  text += format("%s,%d,%d,%s,%d,%d,%d", frame.told ? to_string(frame.mode) : "", frame.reported ? 1 : 0, frame.valid ? 1 : 0,
                 frame.told ? to_string(frame.reason) : "", frame.wrong ? 1 : 0, misleading ? 1 : 0, frame.lost() ? 1 : 0);
  if (!frame.reported) return text + std::string(22, ',') + "\n";
  text += error_cells(frame);
  text +=
      format(",%u,%u,%s,%s", frame.returns, frame.inliers, result.sensors.at(frame.sensor).c_str(), result.parts.at(frame.part).c_str());
  return text + csv_cell(frame.estimate_us) + "\n";
}

}  // namespace

std::string frames_csv(const SimulationResult& result) {
  std::string text = kColumns;
  for (const TableResult& table : result.tables) {
    for (const VariantResult& variant : table.variants) {
      for (std::size_t run = 0; run < variant.cases.size(); ++run) {
        const std::string begin = table.name + "," + variant.variant.name + format(",%zu,", run + 1);
        for (const FrameError& frame : variant.cases[run].frames) text += begin + row(result, frame);
      }
    }
  }
  return text;
}

}  // namespace lasso::mdat
