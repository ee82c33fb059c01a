#include "mdat/benchmark/score_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/common/limits.hpp"
#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using ScoreJson = nlohmann::ordered_json;

Limits limits_of(std::size_t part, std::size_t whole) {
  return share_limits(static_cast<double>(part), static_cast<double>(whole), kScoreConfidence);
}

double share_of(std::size_t part, std::size_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

// "175 (96.7 %; 92.9 % to 98.8 %)": the limits rounded outwards.
std::string count_text(std::size_t part, std::size_t whole) {
  if (whole == 0) return "none";
  return format("%zu (", part) + share_text(share_of(part, whole)) + "; " + limits_text(limits_of(part, whole)) + ")";
}

std::string nees_text(double nees) { return std::isnan(nees) ? "unknown" : format("%.3g", nees); }

std::string nees_text(const Score& score) {
  if (std::isnan(score.nees_median)) return "unknown";
  return nees_text(score.nees_median) + ", " + nees_text(score.nees_worst) + " (" + score.nees_worst_body + ")";
}

std::string time_text(const Score& score) {
  if (score.timed == 0) return "unknown";
  return format("%.3g, %.3g", 1e-3 * score.time.median_us, 1e-3 * score.time.p99_us);
}

std::vector<std::string> score_line(const Score& score) {
  const ScoreCounts& counts = score.counts;
  return {score.program,
          count_text(counts.right, counts.determined),
          count_text(counts.wrong, counts.scans),
          count_text(counts.refused, counts.determined),
          nees_text(score),
          time_text(score)};
}

std::string worst_text(const BodyScore& body) {
  const ScoreCounts& counts = body.counts;
  return format("%s (%s, %.3g m): %zu of %zu wrong; of %zu determined %zu right, %zu refused; NEES ", body.name.c_str(), body.kind.c_str(),
                body.size_m, counts.wrong, counts.scans, counts.determined, counts.right, counts.refused) +
         nees_text(body.nees);
}

// What a reader of the table has to know of it; empty where there is nothing.
std::string notes_text(const std::vector<Score>& scores) {
  std::string without, text;
  for (const Score& score : scores) {
    if (!score.covariances) without += (without.empty() ? "" : ", ") + score.program;
    if (score.missing > 0) text += "  " + score.program + ": " + amount(score.missing, "scan") + " without a row: refused\n";
    if (score.counts.admitted > 0)
      text += "  " + score.program + ": " + amount(score.counts.admitted, "determined scan") +
              " neither right nor wrong: the pose is not near, as its covariance admits\n";
  }
  if (!without.empty()) text += "  no covariance: " + without + ": a valid pose that is not near is wrong, and NEES is unknown\n";
  return text;
}

ScoreJson known_json(double value) { return std::isfinite(value) ? ScoreJson(value) : ScoreJson(); }

ScoreJson share_json(std::size_t part, std::size_t whole) {
  if (whole == 0) return {{"count", part}, {"of", whole}, {"share", nullptr}, {"limits", nullptr}};
  const Limits limits = limits_of(part, whole);
  return {{"count", part}, {"of", whole}, {"share", share_of(part, whole)}, {"limits", {limits.lower, limits.upper}}};
}

ScoreJson counts_json(const ScoreCounts& counts) {
  return {{"scans", counts.scans},
          {"determined", counts.determined},
          {"right", share_json(counts.right, counts.determined)},
          {"wrong", share_json(counts.wrong, counts.scans)},
          {"refused", share_json(counts.refused, counts.determined)},
          {"admitted", share_json(counts.admitted, counts.determined)}};
}

ScoreJson body_json(const BodyScore& body) {
  ScoreJson json = {{"name", body.name}, {"kind", body.kind}, {"what", body.what}, {"size_m", body.size_m}};
  json.update(counts_json(body.counts));
  json["nees"] = known_json(body.nees);
  return json;
}

ScoreJson time_json(const Score& score) {
  if (score.timed == 0) return nullptr;
  return {{"scans", score.timed}, {"median_s", 1e-6 * score.time.median_us}, {"p99_s", 1e-6 * score.time.p99_us}};
}

ScoreJson score_json(const Score& score) {
  ScoreJson json = {{"name", score.program}, {"covariances", score.covariances}, {"missing", score.missing}};
  json.update(counts_json(score.counts));
  json["nees"] = {
      {"median", known_json(score.nees_median)}, {"worst", known_json(score.nees_worst)}, {"worst_body", score.nees_worst_body}};
  json["time"] = time_json(score);
  json["worst_body"] = score.bodies.at(score.worst_body).name;
  json["bodies"] = ScoreJson::array();
  for (const BodyScore& body : score.bodies) json["bodies"].push_back(body_json(body));
  return json;
}

std::string sensor_text(const SetPlan& plan) {
  if (!plan.sensor) return "laser camera or LIDAR, by size";
  return *plan.sensor == SensorKind::kLaserCamera ? "laser camera" : "LIDAR";
}

ScoreJson set_json(const SetPlan& plan) {
  return {{"version", kProtocolVersion},
          {"seed", plan.seed},
          {"bodies", plan.bodies},
          {"scans", plan.scans},
          {"sensor", plan.sensor ? sensor_name(*plan.sensor) : "by size"},
          {"start_deg", plan.start_deg}};
}

std::string csv_number(double value) { return std::isfinite(value) ? format("%.6g", value) : ""; }

std::string csv_row(const Score& score, const ScanScore& scan) {
  const bool refused = scan.verdict == ScanVerdict::kRefused;
  const std::string errors =
      csv_number(scan.error.translation_m) + "," + csv_number(scan.error.rotation_rad / kRadPerDeg) + "," + csv_number(scan.error.squared);
  return score.program + "," + scan.body + "," + scan.scan + (scan.determined ? ",1," : ",0,") + to_string(scan.verdict) + "," +
         (refused ? ",," : errors) + "\n";
}

}  // namespace

std::string set_text(const BenchmarkSet& set, const ScoreCounts& counts) {
  const SetPlan& plan = set.protocol.plan;
  return format("benchmark of %s from seed %llu on, %s each by %s; starts %g deg and %g of the size off\n",
                (plan.bodies == 1 ? "1 body" : format("%zu bodies", plan.bodies)).c_str(), static_cast<unsigned long long>(plan.seed),
                amount(plan.scans, "scan").c_str(), sensor_text(plan).c_str(), plan.start_deg, plan.start_share()) +
         format("%s, of which %zu determine the pose\n", amount(counts.scans, "scan").c_str(), counts.determined);
}

std::string scores_text(const BenchmarkSet& set, const std::vector<Score>& scores) {
  const ScoreCounts& counts = scores.front().counts;
  std::vector<std::vector<std::string>> lines = {
      {"program", format("right, of %zu", counts.determined), format("wrong and valid, of %zu", counts.scans),
       format("refused, of %zu", counts.determined), "NEES: median, worst body", "ms: median, 99 %"}};
  std::string worst;
  for (const Score& score : scores) {
    lines.push_back(score_line(score));
    worst += "  " + score.program + ": " + worst_text(score.bodies.at(score.worst_body)) + "\n";
  }
  const std::string notes = notes_text(scores);
  return set_text(set, counts) + "\n" + aligned_text(lines) + "\nworst body\n" + worst + (notes.empty() ? "" : "\nnotes\n" + notes) +
         format("\nShares with their exact limits at %g %% (Clopper and Pearson), as if each scan were independent of the others.\n",
                100 * kScoreConfidence);
}

std::string scores_json(const BenchmarkSet& set, const std::vector<Score>& scores) {
  ScoreJson json;
  json["set"] = set_json(set.protocol.plan);
  json["confidence"] = kScoreConfidence;
  json["programs"] = ScoreJson::array();
  for (const Score& score : scores) json["programs"].push_back(score_json(score));
  return json.dump(1) + "\n";
}

std::string scores_csv(const std::vector<Score>& scores) {
  std::string text = "program,body,scan,determined,verdict,error_m,error_deg,squared\n";
  for (const Score& score : scores) {
    for (const ScanScore& scan : score.scans) text += csv_row(score, scan);
  }
  return text;
}

}  // namespace lasso::mdat
