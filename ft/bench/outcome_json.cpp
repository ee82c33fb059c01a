#include <nlohmann/json.hpp>

#include "ft/bench/outcome_table.hpp"

namespace lasso::bench {
namespace {

using Json = nlohmann::ordered_json;

Json figures(const MethodResult& result) {
  const mdat::RunStatistics& s = result.statistics;
  Json json = {
      {"us", s.time.median_us}, {"p99_us", s.time.p99_us},        {"rms_mm", s.registration.rms_mm}, {"rms_deg", s.registration.rms_deg},
      {"lost", s.lost},         {"iterations", result.iterations}};
  if (result.peer) return json;
  json["p99_over_median"] = s.time.p99_us / s.time.median_us;
  json["invalid"] = s.invalid;
  return json;
}

// How many times longer the peer takes than the estimator, hits alone and with silhouettes.
Json ratios(const std::vector<MethodResult>& results, const MethodResult& peer) {
  const double us = peer.statistics.time.median_us;
  return {{"over_hits", us / result_of(results, kHits).statistics.time.median_us},
          {"over_silhouettes", us / result_of(results, kSilhouettes).statistics.time.median_us}};
}

// The noisy figures stand first, all of them in their own objects.
Json method_json(const Comparison& c, const MethodResult& noisy) {
  const MethodResult& noise_free = result_of(c.noise_free, noisy.name);
  Json json = {{"name", noisy.name}};
  json.update(figures(noisy));
  json["noise_free"] = figures(noise_free);
  json["noisy"] = figures(noisy);
  if (noisy.peer) {
    json["noise_free"].update(ratios(c.noise_free, noise_free));
    json["noisy"].update(ratios(c.noisy, noisy));
    return json;
  }
  const mdat::RunStatistics& s = noisy.statistics;
  json["noisy"].update({{"crlb_mm", s.crlb_mm}, {"crlb_deg", s.crlb_deg}, {"nees", s.nees}});
  return json;
}

Json time_json(const Comparison& c, const char* name) {
  const auto times = [&](const std::vector<MethodResult>& results) {
    const mdat::TimeStatistics& time = result_of(results, name).statistics.time;
    return Json{{"median", time.median_us}, {"p99", time.p99_us}, {"max", time.max_us}};
  };
  Json json = times(c.noisy);
  json["noise_free"] = times(c.noise_free);
  return json;
}

}  // namespace

std::string table_json(const Comparison& c) {
  Json json = {{"mission", c.mission}, {"scenario", c.scenario}, {"scans", c.scans}};
  json["estimate_us"] = {{"hits", time_json(c, kHits)}, {"silhouettes", time_json(c, kSilhouettes)}};
  json["lasso"] = Json::array();
  json["peers"] = Json::array();
  for (const MethodResult& noisy : c.noisy) json[noisy.peer ? "peers" : "lasso"].push_back(method_json(c, noisy));
  return json.dump(2) + "\n";
}

}  // namespace lasso::bench
