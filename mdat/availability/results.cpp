#include "mdat/availability/results.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::vector<std::string>>;

std::vector<std::string> phase_line(const std::string& head, const std::string& light, const FrameFigures& figures) {
  return {"  " + head,
          light,
          count_text(figures),
          format("%zu", figures.wrong),
          known(figures.median_mm, 2, "-"),
          known(figures.rms_mm, 2, "-"),
          known(figures.median_deg, 3, "-"),
          known(figures.rms_deg, 3, "-"),
          known(figures.nees, 1, "-")};
}

std::vector<std::string> phase_head() {
  return {"", "light", "available", "wrong", "mm: median", "rms", "deg: median", "rms", "NEES of 6"};
}

void add_phases(const std::string& title, const std::vector<SeenFrame>& frames, Lines& lines) {
  std::string head = title;
  for (const LightPhase phase : kLightPhases) {
    const FrameFigures figures = figures_in(frames, phase);
    if (figures.frames == 0) continue;
    lines.push_back(phase_line(head, phase_name(phase), figures));
    head.clear();
  }
  lines.push_back(phase_line(head, "all", figures_of(frames)));
}

std::string orbits_text(const HeadComparison& comparison) {
  Lines lines = {{"  available", "all orbits", "95 % limits", "wrong"}};
  const std::vector<double> betas = betas_of(comparison.heads.front().orbits);
  for (const double beta_rad : betas) lines[0].push_back(format("beta %g deg", beta_rad / kRadPerDeg));
  for (const HeadResult& head : comparison.heads) {
    const FrameFigures all = figures_of(frames_of(head.orbits));
    lines.push_back({"  " + head.head.title, count_text(all), limits_text(all.limits()), format("%zu", all.wrong)});
    for (const double beta_rad : betas) lines.back().push_back(count_text(figures_of(frames_at(head.orbits, beta_rad))));
  }
  return aligned_text(lines);
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json figures_json(const FrameFigures& figures) {
  const Limits limits = figures.limits();
  return {{"frames", figures.frames},           {"available", figures.available},           {"wrong", figures.wrong},
          {"share", figures.share()},           {"share_95", {limits.lower, limits.upper}}, {"median_mm", number(figures.median_mm)},
          {"rms_mm", number(figures.rms_mm)},   {"worst_mm", number(figures.worst_mm)},     {"median_deg", number(figures.median_deg)},
          {"rms_deg", number(figures.rms_deg)}, {"worst_deg", number(figures.worst_deg)},   {"nees", number(figures.nees)}};
}

Json phases_json(const std::vector<SeenFrame>& frames) {
  Json json = {{"all", figures_json(figures_of(frames))}};
  for (const LightPhase phase : kLightPhases) json[phase_name(phase)] = figures_json(figures_in(frames, phase));
  return json;
}

Json orbits_json(const std::vector<OrbitSample>& samples) {
  Json json = phases_json(frames_of(samples));
  json["by_beta"] = Json::array();
  for (const double beta_rad : betas_of(samples)) {
    Json of_beta = figures_json(figures_of(frames_at(samples, beta_rad)));
    of_beta["beta_deg"] = beta_rad / kRadPerDeg;
    json["by_beta"].push_back(of_beta);
  }
  return json;
}

const char* laser_word(LaserInLight laser) {
  switch (laser) {
    case LaserInLight::kSameBits:
      return "same_bits";
    case LaserInLight::kOtherBits:
      return "other_bits";
    case LaserInLight::kOtherMotion:
      return "other_motion";
    case LaserInLight::kNotCompared:
      break;
  }
  return "not_compared";
}

std::string seen_cells(const SeenFrame& seen) {
  const FrameError& error = seen.error;
  const LightAt& light = seen.light;
  std::string cells = format("%.3f", error.t_s) + csv_cell(error.range_m) + ',' + phase_name(phase_of(light)) + csv_cell(light.sun_share) +
                      csv_cell(light.sun_off_rad / kRadPerDeg) + csv_cell(light.earth_lit) + ',';
  cells += format("%d,%d,%s,%u", error.valid ? 1 : 0, error.wrong ? 1 : 0, to_string(error.reason), error.returns);
  if (!error.valid) return cells + ",,,,,";
  return cells + csv_cell(1e3 * error.registration.translation_m.norm()) + csv_cell(error.registration.rotation_rad / kRadPerDeg) +
         csv_cell(1e3 * error.sigma_m) + csv_cell(error.sigma_rad / kRadPerDeg) + csv_cell(error.nees);
}

}  // namespace

std::string count_text(const FrameFigures& figures) {
  return format("%zu/%zu", figures.available, figures.frames) + " (" + share_text(figures.share()) + ")";
}

std::string laser_text(LaserInLight laser) {
  switch (laser) {
    case LaserInLight::kSameBits:
      return "The laser camera's telemetry of one view is the same to the bit in the light of each sample.";
    case LaserInLight::kOtherBits:
      return "The laser camera's telemetry differs with the light: its detector sees the Sun ([sensor.detector]).";
    case LaserInLight::kOtherMotion:
      return "The target's motion differs with the Sun's place, so the laser camera's telemetry was not compared between lights.";
    case LaserInLight::kNotCompared:
      break;
  }
  return "The laser camera's telemetry was not compared between lights: no two were flown.";
}

std::string comparison_text(const HeadComparison& comparison) {
  Lines lines = {phase_head()};
  for (const HeadResult& head : comparison.heads) add_phases(head.head.title, head.approach, lines);
  std::string text =
      "\n" + comparison.mission + ", scenario " + comparison.approach + ": poses of single scans by light\n" + aligned_text(lines);
  for (const LightPhase phase : kLightPhases) text += format("  %s: %s\n", phase_name(phase), phase_meaning(phase));
  if (comparison.heads.front().orbits.empty()) return text + "\n";
  text +=
      "\nWhole orbits, by samples: scenario " + comparison.hold + ", its first frame, each in another attitude\n" + orbits_text(comparison);
  text +=
      format("  beside: the 2005 paper gives camera systems %.0f %%; what it counts is not known here\n", 100 * kPaperCameraAvailability);
  return text + "  " + laser_text(comparison.laser) + "\n\n";
}

std::string comparison_json(const HeadComparison& comparison) {
  Json json = {{"version", kVersion},
               {"commit", comparison.commit},
               {"mission", comparison.mission},
               {"approach", comparison.approach},
               {"hold", comparison.hold},
               {"period_s", comparison.period_s},
               {"seconds", comparison.seconds},
               {"paper_camera_availability", kPaperCameraAvailability},
               {"laser_in_each_light", laser_word(comparison.laser)}};
  for (const HeadResult& head : comparison.heads)
    json["heads"][head.head.key] = {
        {"settings", head.head.settings}, {"approach", phases_json(head.approach)}, {"orbits", orbits_json(head.orbits)}};
  return json.dump(2) + "\n";
}

std::string comparison_csv(const HeadComparison& comparison) {
  std::string text =
      "flight,head,beta_deg,angle_deg,t_s,range_m,light,sun_share,sun_off_deg,earth_lit,valid,wrong,reason,returns,error_mm,error_deg,"
      "sigma_mm,sigma_deg,nees\n";
  for (const HeadResult& head : comparison.heads) {
    for (const SeenFrame& seen : head.approach) text += "approach," + head.head.key + ",,," + seen_cells(seen) + "\n";
    for (const OrbitSample& sample : head.orbits)
      text += "orbit," + head.head.key + csv_cell(sample.beta_rad / kRadPerDeg) + csv_cell(sample.angle_rad / kRadPerDeg) + ',' +
              seen_cells(sample.seen) + "\n";
  }
  return text;
}

}  // namespace lasso::mdat
