#include "ft/bench/outcome_table.hpp"

#include "mdat/common/text.hpp"

namespace lasso::bench {
namespace {

using mdat::format;

double median_us(const std::vector<MethodResult>& results, const char* name) { return result_of(results, name).statistics.time.median_us; }

double tail_ratio(const MethodResult& result) { return result.statistics.time.p99_us / result.statistics.time.median_us; }

std::string row(const std::vector<MethodResult>& results, const MethodResult& result) {
  const mdat::RunStatistics& s = result.statistics;
  std::string text = format("  %-25s %9.1f %9.1f %6.2f %6.1f %9.4f %9.5f %6zu", result.name.c_str(), s.time.median_us, s.time.p99_us,
                            tail_ratio(result), result.iterations, s.registration.rms_mm, s.registration.rms_deg, s.lost);
  if (result.peer) {
    text += format(" %8.1f %12.1f", s.time.median_us / median_us(results, kHits), s.time.median_us / median_us(results, kSilhouettes));
  }
  return text + "\n";
}

std::string section(const char* title, const std::vector<MethodResult>& results) {
  constexpr const char* kColumns = "  %-25s %9s %9s %6s %6s %9s %9s %6s %8s %12s\n";
  std::string text = std::string(title) + "\n";
  text += format(kColumns, "", "median us", "p99 us", "p99 /", "passes", "rms mm", "rms deg", "lost", "its time", "over");
  text += format(kColumns, "", "", "", "median", "", "", "", "", "hits", "silhouettes");
  for (const MethodResult& result : results) text += row(results, result);
  return text;
}

std::string honesty_line(const std::vector<MethodResult>& noisy, const char* name) {
  const mdat::RunStatistics& s = result_of(noisy, name).statistics;
  return format("  %-25s rms over the Cramer-Rao bound of the hits (%.4f mm, %.5f deg): %.3f and %.3f; NEES %.2f (6 is honest)\n", name,
                s.crlb_mm, s.crlb_deg, s.registration.rms_mm / s.crlb_mm, s.registration.rms_deg / s.crlb_deg, s.nees);
}

bool more_accurate(const MethodResult& method, const MethodResult& peer) {
  const mdat::RunStatistics &a = method.statistics, &b = peer.statistics;
  return a.lost <= b.lost && a.registration.rms_mm < b.registration.rms_mm && a.registration.rms_deg < b.registration.rms_deg;
}

struct SpeedRequirement {
  const char* method;
  const char* peer;
  double times;
};
constexpr SpeedRequirement kSpeeds[] = {{kHits, kEmbree, 3}, {kHits, kPcl, 15}, {kSilhouettes, kEmbree, 1}, {kSilhouettes, kPcl, 5}};
constexpr double kTailMax = 3;

std::string speed_line(const SpeedRequirement& required, const char* noise, const std::vector<MethodResult>& results) {
  const double times = median_us(results, required.peer) / median_us(results, required.method);
  const bool accurate = more_accurate(result_of(results, required.method), result_of(results, required.peer));
  return format("  %-18s over %-21s %-11s %6.1f times faster (at least %2.0f)%s, %s\n", required.method, required.peer, noise, times,
                required.times, times < required.times ? " NOT MET" : "", accurate ? "more accurate" : "NOT more accurate");
}

std::string tail_line(const char* method, const char* noise, const std::vector<MethodResult>& results) {
  const double ratio = tail_ratio(result_of(results, method));
  return format("  %-18s p99 over median            %-11s %6.2f (at most %.0f)%s\n", method, noise, ratio, kTailMax,
                ratio > kTailMax ? " NOT MET" : "");
}

std::string requirements(const char* noise, const std::vector<MethodResult>& results) {
  std::string text;
  for (const SpeedRequirement& required : kSpeeds) text += speed_line(required, noise, results);
  return text + tail_line(kHits, noise, results) + tail_line(kSilhouettes, noise, results);
}

}  // namespace

std::string table_text(const Comparison& c) {
  std::string text =
      format("%s, scenario %s: %zu scans, each registered from the pose of one frame before; processor time of one thread.\n",
             c.mission.c_str(), c.scenario.c_str(), c.scans);
  text += "Only ratios within one run hold: machine and load change the times.\n\n";
  text += section("without noise", c.noise_free) + "\n" + section("with noise", c.noisy);
  for (const char* name : {kHits, kSilhouettes}) text += honesty_line(c.noisy, name);
  return text + "\nrequired\n" + requirements("noise-free", c.noise_free) + requirements("noisy", c.noisy);
}

}  // namespace lasso::bench
