#include "mdat/trial/trial_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

// The fields of which a mean is formed.
constexpr double DisparityErrors::*kMeanFields[] = {&DisparityErrors::valid_share,    &DisparityErrors::sky_share,
                                                    &DisparityErrors::bias_px,        &DisparityErrors::sigma_px,
                                                    &DisparityErrors::wrong_interior, &DisparityErrors::wrong_edge};
constexpr double PairFigures::*kMeans[] = {&PairFigures::valid_share, &PairFigures::sky_share,      &PairFigures::bias_px,
                                           &PairFigures::sigma_px,    &PairFigures::wrong_interior, &PairFigures::wrong_edge};

struct Sizes {
  double median, rms, worst;
};

Sizes sizes_of(std::vector<double> values) {
  if (values.empty()) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone, kNone};
  }
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value * value;
  return {values[(values.size() - 1) / 2], std::sqrt(sum / static_cast<double>(values.size())), values.back()};
}

Json figure(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::vector<std::string> pair_line(const std::string& name, const PairFigures& f) {
  return {"  " + name,
          known(1e3 * f.exposure_s, 2, "-"),
          known(f.valid_share, 3, "-"),
          known(100 * f.sky_share, 2, "-"),
          known(f.bias_px, 3, "-"),
          known(f.sigma_px, 3, "-"),
          known(100 * f.wrong_interior, 1, "-"),
          known(100 * f.wrong_edge, 1, "-")};
}

std::vector<std::string> pose_line(const std::string& name, const PoseFigures& f) {
  return {"  " + name,
          format("%zu/%zu", f.valid, f.scans),
          format("%zu", f.wrong),
          known(f.median_mm, 2, "-"),
          known(f.rms_mm, 2, "-"),
          known(f.worst_mm, 2, "-"),
          known(f.median_deg, 3, "-"),
          known(f.rms_deg, 3, "-"),
          known(f.worst_deg, 3, "-"),
          known(f.squared_position, 2, "-"),
          known(f.squared_attitude, 2, "-"),
          known(f.nees, 1, "-")};
}

std::string pose_cells(const TrialPose& pose) {
  return format(",%u,%u,%u,%s,%d,%u", pose.view, pose.draw, pose.scan, to_string(pose.reason), pose.wrong ? 1 : 0, pose.returns) +
         csv_cell(1e3 * pose.off_m) + csv_cell(pose.off_rad / kRadPerDeg) + csv_cell(1e3 * pose.sigma_m) +
         csv_cell(pose.sigma_rad / kRadPerDeg) + csv_cell(pose.squared_position) + csv_cell(pose.squared_attitude) + csv_cell(pose.nees);
}

std::vector<std::string> fitted_line(const std::string& name, const PoseFigures& rendered, const PoseFigures& fitted) {
  std::vector<std::string> line = {"  " + name, format("%zu/%zu", fitted.valid, fitted.scans), format("%zu", fitted.wrong)};
  for (const auto& [figure, digits] : {std::pair{&PoseFigures::rms_mm, 2}, {&PoseFigures::rms_deg, 3}, {&PoseFigures::nees, 1}}) {
    line.push_back(known(fitted.*figure, digits, "-"));
    line.push_back(known(fitted.*figure / rendered.*figure, 2, "-"));
  }
  return line;
}

Json pair_json(const PairFigures& f) {
  return {{"pairs", f.pairs},
          {"exposure_ms", 1e3 * f.exposure_s},
          {"valid_share", f.valid_share},
          {"sky_share", f.sky_share},
          {"bias_px", f.bias_px},
          {"sigma_px", f.sigma_px},
          {"wrong_interior", f.wrong_interior},
          {"wrong_edge", f.wrong_edge}};
}

}  // namespace

PairFigures pair_figures(const TrialResult& result, std::size_t light) {
  PairFigures figures;
  for (const TrialPair& pair : result.pairs) {
    if (pair.light != light) continue;
    ++figures.pairs;
    figures.exposure_s += pair.exposure_s;
    for (std::size_t i = 0; i < std::size(kMeans); ++i) figures.*kMeans[i] += pair.errors.*kMeanFields[i];
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, figures.pairs));
  figures.exposure_s /= count;
  for (const auto mean : kMeans) figures.*mean /= count;
  return figures;
}

std::vector<TrialPose> poses_in(const std::vector<TrialPose>& all, std::size_t light) {
  std::vector<TrialPose> poses;
  std::copy_if(all.begin(), all.end(), std::back_inserter(poses), [&](const TrialPose& pose) { return pose.light == light; });
  return poses;
}

PoseFigures pose_figures(const std::vector<TrialPose>& poses) {
  PoseFigures figures;
  std::vector<double> mm, deg;
  for (const TrialPose& pose : poses) {
    ++figures.scans;
    if (!pose.valid()) continue;
    ++figures.valid;
    if (pose.wrong) ++figures.wrong;
    mm.push_back(1e3 * pose.off_m);
    deg.push_back(pose.off_rad / kRadPerDeg);
    figures.squared_position += pose.squared_position;
    figures.squared_attitude += pose.squared_attitude;
    figures.nees += pose.nees;
  }
  for (double* mean : {&figures.squared_position, &figures.squared_attitude, &figures.nees}) *mean /= static_cast<double>(figures.valid);
  const Sizes position = sizes_of(mm), attitude = sizes_of(deg);
  figures.median_mm = position.median;
  figures.rms_mm = position.rms;
  figures.worst_mm = position.worst;
  figures.median_deg = attitude.median;
  figures.rms_deg = attitude.rms;
  figures.worst_deg = attitude.worst;
  return figures;
}

std::string fitted_table(const std::vector<TrialLight>& lights, const std::vector<TrialPose>& rendered,
                         const std::vector<TrialPose>& fitted) {
  std::vector<std::vector<std::string>> lines = {
      {"  the fitted model", "valid", "wrong", "rms, mm", "/ rendered", "rms, deg", "/ rendered", "NEES of 6", "/ rendered"}};
  for (std::size_t light = 0; light < lights.size(); ++light)
    lines.push_back(fitted_line(lights[light].name, pose_figures(poses_in(rendered, light)), pose_figures(poses_in(fitted, light))));
  lines.push_back(fitted_line("all", pose_figures(rendered), pose_figures(fitted)));
  return aligned_text(lines);
}

std::string pose_table(const std::string& title, const std::vector<TrialLight>& lights, const std::vector<TrialPose>& poses) {
  std::vector<std::vector<std::string>> lines = {{"  " + title, "valid", "wrong", "mm: median", "rms", "worst", "deg: median", "rms",
                                                  "worst", "squared: position", "attitude", "NEES of 6"}};
  for (std::size_t light = 0; light < lights.size(); ++light)
    lines.push_back(pose_line(lights[light].name, pose_figures(poses_in(poses, light))));
  lines.push_back(pose_line("all", pose_figures(poses)));
  return aligned_text(lines);
}

std::string trial_text(const TrialResult& result) {
  std::vector<std::vector<std::string>> pairs = {
      {"  means of pairs", "exposure, ms", "valid share", "sky, %", "bias, px", "sigma, px", "> 1 px: inside, %", "at edges, %"}};
  for (std::size_t light = 0; light < result.lights.size(); ++light)
    pairs.push_back(pair_line(result.lights[light].name, pair_figures(result, light)));
  return (result.pairs.empty() ? "" : "\n" + aligned_text(pairs) + "\n" + pose_table("single scans", result.lights, result.poses)) + "\n" +
         fitted_table(result.lights, result.poses, result.fitted) +
         "  squared: errors over their sigmas, squared, for each axis: 1 where covariances are honest\n\n";
}

nlohmann::ordered_json pose_json(const PoseFigures& f) {
  return {{"scans", f.scans},
          {"valid", f.valid},
          {"wrong", f.wrong},
          {"median_mm", figure(f.median_mm)},
          {"rms_mm", figure(f.rms_mm)},
          {"worst_mm", figure(f.worst_mm)},
          {"median_deg", figure(f.median_deg)},
          {"rms_deg", figure(f.rms_deg)},
          {"worst_deg", figure(f.worst_deg)},
          {"squared_position", figure(f.squared_position)},
          {"squared_attitude", figure(f.squared_attitude)},
          {"nees", figure(f.nees)}};
}

std::string trial_json(const TrialResult& result) {
  Json json = {{"version", kVersion}, {"scenario", result.scenario}, {"range_m", result.range_m}};
  for (std::size_t light = 0; light < result.lights.size(); ++light)
    json["lights"][result.lights[light].name] = {{"pairs", pair_json(pair_figures(result, light))},
                                                 {"poses", pose_json(pose_figures(poses_in(result.poses, light)))},
                                                 {"fitted", pose_json(pose_figures(poses_in(result.fitted, light)))}};
  json["all"] = pose_json(pose_figures(result.poses));
  json["all_fitted"] = pose_json(pose_figures(result.fitted));
  return json.dump(2) + "\n";
}

std::string trial_pairs_csv(const TrialResult& result) {
  std::string text = "light,view,time_s,exposure_ms,valid_share,sky_share,bias_px,sigma_px,wrong_interior,wrong_edge\n";
  for (const TrialPair& pair : result.pairs) {
    text += result.lights[pair.light].name + format(",%u,%.6f", pair.view, pair.time_s) + csv_cell(1e3 * pair.exposure_s);
    for (const auto field : kMeanFields) text += csv_cell(pair.errors.*field);
    text += '\n';
  }
  return text;
}

std::string poses_csv(const std::vector<TrialLight>& lights, const std::vector<TrialPose>& rendered, const std::vector<TrialPose>& fitted,
                      const std::string& which) {
  std::string text =
      "model,light," + which + ",reason,wrong,returns,error_mm,error_deg,sigma_mm,sigma_deg,squared_position,squared_attitude,nees\n";
  for (const std::vector<TrialPose>* poses : {&rendered, &fitted}) {
    for (const TrialPose& pose : *poses)
      text += (poses == &rendered ? "rendered," : "fitted,") + lights[pose.light].name + pose_cells(pose) + '\n';
  }
  return text;
}

std::string trial_poses_csv(const TrialResult& result) { return poses_csv(result.lights, result.poses, result.fitted, "view,draw,scan"); }

}  // namespace lasso::mdat
