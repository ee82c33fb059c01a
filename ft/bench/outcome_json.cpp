#include <cmath>
#include <nlohmann/json.hpp>

#include "ft/bench/outcome_table.hpp"

namespace lasso::bench {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value) { return std::round(1e6 * value) / 1e6; }

Json figures(const MethodResult& result) {
  const mdat::RunStatistics& s = result.statistics;
  Json json = {{"us", rounded(s.time.median_us)},
               {"p99_us", rounded(s.time.p99_us)},
               {"us_by_turns", rounded(result.by_turns.median_us)},
               {"p99_us_by_turns", rounded(result.by_turns.p99_us)},
               {"rms_mm", rounded(s.registration.rms_mm)},
               {"rms_deg", rounded(s.registration.rms_deg)},
               {"lost", s.lost},
               {"iterations", rounded(result.iterations)}};
  if (result.peer) return json;
  json["p99_over_median"] = rounded(s.time.p99_us / s.time.median_us);
  json["invalid"] = s.invalid;
  return json;
}

// How many times longer the peer takes than the estimator, hits alone and with silhouettes.
Json ratios(const std::vector<MethodResult>& results, const MethodResult& peer) {
  const MethodResult &hits = result_of(results, kHits), &silhouettes = result_of(results, kSilhouettes);
  return {{"over_hits", rounded(peer.statistics.time.median_us / hits.statistics.time.median_us)},
          {"over_silhouettes", rounded(peer.statistics.time.median_us / silhouettes.statistics.time.median_us)},
          {"over_hits_by_turns", rounded(peer.by_turns.median_us / hits.by_turns.median_us)},
          {"over_silhouettes_by_turns", rounded(peer.by_turns.median_us / silhouettes.by_turns.median_us)}};
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
  json["noisy"].update({{"crlb_mm", rounded(s.crlb_mm)}, {"crlb_deg", rounded(s.crlb_deg)}, {"nees", rounded(s.nees)}});
  return json;
}

Json time_json(const Comparison& c, const char* name) {
  const auto times = [&](const std::vector<MethodResult>& results) {
    const mdat::TimeStatistics& time = result_of(results, name).statistics.time;
    return Json{{"median", rounded(time.median_us)}, {"p99", rounded(time.p99_us)}, {"max", rounded(time.max_us)}};
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
