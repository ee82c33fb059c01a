#include "mdat/run/integrity.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/common/limits.hpp"
#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kConfidence = 0.95;

Limits limits_of(std::size_t some, std::size_t all) {
  return share_limits(static_cast<double>(some), static_cast<double>(all), kConfidence);
}

double upper_limit(std::size_t some, std::size_t all) {
  return upper_share_limit(static_cast<double>(some), static_cast<double>(all), kConfidence);
}

Json level_json(const LevelStatistics& level, const char* median, const char* worst) {
  return {{"misleading", level.misleading}, {median, level.median}, {worst, level.worst}};
}

// From a hundred on to whole units: no powers of ten.
std::string digits(double value, int count, const char* nothing) {
  if (std::isnan(value)) return nothing;
  return value >= 99.5 ? format("%.0f", value) : format("%.*g", count, value);
}

std::string none_text(std::size_t all) { return "at most " + upper_limit_text(upper_limit(0, all)); }

// "12 of 1000, 0.62 % to 2.1 %".
std::string some_text(std::size_t some, std::size_t all) {
  return format("%zu of %zu, ", some, all) + (some == 0 ? none_text(all) : limits_text(limits_of(some, all)));
}

std::string episodes_text(const AlertStatistics& alert) {
  const std::string text = amount(alert.episodes, "episode");
  return alert.censored == 0 ? text : text + format(", %zu censored", alert.censored);
}

std::string wrong_text(const Integrity& integrity) {
  if (integrity.protection.poses == 0) return "no valid pose";
  if (integrity.wrong == 0) return "no wrong pose, " + none_text(integrity.protection.poses);
  return amount(integrity.wrong, "pose") + " in " + episodes_text(integrity.alert);
}

// With the flights of a campaign, which are independent.
std::string wrong_and_flights_text(const Integrity& integrity) {
  const std::size_t poses = integrity.protection.poses;
  if (poses == 0) return "no valid pose";
  const std::string text = integrity.wrong == 0 ? format("no wrong pose in %zu, ", poses) + none_text(poses)
                                                : some_text(integrity.wrong, poses) + "; " + episodes_text(integrity.alert);
  return integrity.flights == 0 ? text : text + "; flights with one: " + some_text(integrity.wrong_flights, integrity.flights);
}

std::string worst_text(const AlertStatistics& alert, const char* nothing) {
  return (alert.worst_is_censored ? ">= " : "") + digits(alert.worst_s, 3, nothing);
}

std::string alert_text(const AlertStatistics& alert) {
  if (alert.episodes == 0) return "no wrong pose";
  return format("median %.3g s, 95 %% %.3g s, worst ", alert.median_s, alert.p95_s) + worst_text(alert, "") + " s";
}

std::string misleading_text(const ProtectionStatistics& protection, const char* nothing) {
  return protection.poses == 0 ? nothing : some_text(protection.misleading, protection.poses);
}

std::string both_text(const ProtectionStatistics& protection) {
  std::string text = misleading_text(protection, "no valid pose");
  if (protection.misleading == 0) return text;
  return text + format("; by position %zu, by attitude %zu", protection.position_mm.misleading, protection.attitude_deg.misleading);
}

std::string level_text(const LevelStatistics& level, const char* unit) {
  if (std::isnan(level.median)) return "no valid pose";
  return "median " + digits(level.median, 3, "") + format(" %s, worst ", unit) + digits(level.worst, 3, "") + " " + unit;
}

}  // namespace

const char* const kIntegrityNote =
    "Time to alert: from the first pose of an episode that is valid and wrong to the first frame that is not: median, 95 % and worst. An "
    "episode is censored where its flight ended first; it counts as that long at least. Protection level: the bound of the error that an "
    "honest covariance lets it exceed with a probability of 1e-4: median and worst of the valid poses. Misleading: valid, and farther off "
    "than its level, in position or attitude. Limits hold at 95 %, as if poses were independent.";

Integrity integrity_of(const RunStatistics& run) { return {run.wrong, run.alert.statistics(), run.protection}; }

Json integrity_json(const Integrity& integrity) {
  const AlertStatistics& alert = integrity.alert;
  const ProtectionStatistics& protection = integrity.protection;
  const Limits limits = limits_of(protection.misleading, protection.poses);
  const double share = static_cast<double>(protection.misleading) / static_cast<double>(protection.poses);  // not a number of no pose
  Json json;
  json["time_to_alert"] = {{"episodes", alert.episodes}, {"censored", alert.censored}, {"median_s", alert.median_s},
                           {"p95_s", alert.p95_s},       {"worst_s", alert.worst_s},   {"worst_is_censored", alert.worst_is_censored}};
  json["time_to_alert"]["wrong_share_at_most"] = upper_limit(integrity.wrong, protection.poses);
  if (integrity.flights > 0) {
    const Limits of_flights = limits_of(integrity.wrong_flights, integrity.flights);
    json["time_to_alert"].update({{"flights", integrity.flights},
                                  {"wrong_flights", integrity.wrong_flights},
                                  {"wrong_flights_share_limits", {of_flights.lower, of_flights.upper}}});
  }
  json["protection"] = {{"risk", kProtectionRisk}, {"poses", protection.poses}, {"misleading", protection.misleading}};
  json["protection"]["misleading_share"] = share;
  json["protection"]["misleading_share_limits"] = {limits.lower, limits.upper};
  json["protection"]["position"] = level_json(protection.position_mm, "median_mm", "worst_mm");
  json["protection"]["attitude"] = level_json(protection.attitude_deg, "median_deg", "worst_deg");
  return json;
}

std::vector<std::string> integrity_head(const std::string& first) {
  return {first,
          "valid and wrong",
          "time to alert, s: median",
          "95 %",
          "worst",
          "misleading",
          "level, mm: median",
          "worst",
          "level, deg: median",
          "worst"};
}

std::vector<std::string> integrity_row(const std::string& name, const Integrity& integrity, const char* nothing) {
  const AlertStatistics& alert = integrity.alert;
  const ProtectionStatistics& protection = integrity.protection;
  const auto time = [&](double value_s) { return digits(value_s, 3, nothing); };
  const auto level = [&](double value) { return digits(value, 2, nothing); };
  return {name,
          wrong_text(integrity),
          time(alert.median_s),
          time(alert.p95_s),
          worst_text(alert, nothing),
          misleading_text(protection, nothing),
          level(protection.position_mm.median),
          level(protection.position_mm.worst),
          level(protection.attitude_deg.median),
          level(protection.attitude_deg.worst)};
}

std::vector<std::vector<std::string>> integrity_list(const Integrity& integrity) {
  const ProtectionStatistics& protection = integrity.protection;
  return {{"valid and wrong", wrong_and_flights_text(integrity)},
          {"time to alert", alert_text(integrity.alert)},
          {"misleading", both_text(protection)},
          {"protection level, position", level_text(protection.position_mm, "mm")},
          {"protection level, attitude", level_text(protection.attitude_deg, "deg")}};
}

}  // namespace lasso::mdat
