#include "ft/bench/outcome_table.hpp"

#include <algorithm>

#include "mdat/common/text.hpp"

namespace lasso::bench {
namespace {

using mdat::format;
using Results = std::vector<MethodResult>;

double tail(const mdat::TimeStatistics& time) { return time.p99_us / time.median_us; }

std::string row(const Results& results, const MethodResult& result) {
  const mdat::RunStatistics& s = result.statistics;
  std::string text = format("  %-24s %7.0f %7.0f %6.2f %8.0f %7.0f %8.1f %9.4f %9.5f %5zu", result.name.c_str(), s.time.median_us,
                            s.time.p99_us, tail(s.time), result.by_turns.median_us, result.by_turns.p99_us, result.iterations,
                            s.registration.rms_mm, s.registration.rms_deg, s.lost);
  for (const char* name : {kHits, kSilhouettes}) {
    if (result.peer) text += format(" %8.1f", s.time.median_us / result_of(results, name).statistics.time.median_us);
  }
  return text + "\n";
}

std::string section(const char* title, const Results& results) {
  constexpr const char* kColumns = "  %-24s %7s %7s %6s %8s %7s %8s %9s %9s %5s %17s\n";
  std::string text = std::string(title) + "\n";
  text += format(kColumns, "", "us in a", "", "p99 /", "us by", "", "", "", "", "", "its time over");
  text += format(kColumns, "", "row", "p99", "median", "turns", "p99", "passes", "rms mm", "rms deg", "lost", "hits'  silhou.'");
  for (const MethodResult& result : results) text += row(results, result);
  return text;
}

std::string bound_line(const Results& noisy, const char* name) {
  const mdat::RunStatistics& s = result_of(noisy, name).statistics;
  return format("  %-24s rms over the Cramer-Rao bound of the hits (%.4f mm, %.5f deg): %.3f and %.3f; NEES %.2f (honest: 6)\n", name,
                s.crlb_mm, s.crlb_deg, s.registration.rms_mm / s.crlb_mm, s.registration.rms_deg / s.crlb_deg, s.nees);
}

// The four measurements of a run. Requirements are judged in a row: a tracker that has its processor to itself.
struct Four {
  double row, turns, noisy_row, noisy_turns;
};

std::string required_line(const std::string& what, const char* limit, const Four& figures, bool met) {
  return format("  %-59s %11s %9.2f %9.2f %9.2f %9.2f   %s\n", what.c_str(), limit, figures.row, figures.turns, figures.noisy_row,
                figures.noisy_turns, met ? "met" : "NOT MET");
}

double times_faster(const Results& results, const char* name, const char* peer, bool by_turns) {
  const MethodResult &a = result_of(results, name), &b = result_of(results, peer);
  if (by_turns) return b.by_turns.median_us / a.by_turns.median_us;
  return b.statistics.time.median_us / a.statistics.time.median_us;
}

struct SpeedRequirement {
  const char* method;
  const char* peer;
  double times;
};
constexpr SpeedRequirement kSpeeds[] = {{kHits, kEmbree, 3}, {kHits, kPcl, 15}, {kSilhouettes, kEmbree, 1}, {kSilhouettes, kPcl, 5}};

std::string speed_line(const Comparison& c, const SpeedRequirement& r) {
  const Four times = {times_faster(c.noise_free, r.method, r.peer, false), times_faster(c.noise_free, r.method, r.peer, true),
                      times_faster(c.noisy, r.method, r.peer, false), times_faster(c.noisy, r.method, r.peer, true)};
  const bool met = std::min(times.row, times.noisy_row) >= r.times;
  return required_line(format("%s: times faster than %s", r.method, r.peer), format(">= %.0f", r.times).c_str(), times, met);
}

std::string tail_line(const Comparison& c, const char* name) {
  const MethodResult &clean = result_of(c.noise_free, name), &noisy = result_of(c.noisy, name);
  const Four tails = {tail(clean.statistics.time), tail(clean.by_turns), tail(noisy.statistics.time), tail(noisy.by_turns)};
  const bool met = std::max(tails.row, tails.noisy_row) <= 3;
  return required_line(format("%s: p99 over median", name), "<= 3", tails, met);
}

const char* compared(const Results& results, const SpeedRequirement& r) {
  const mdat::RunStatistics &a = result_of(results, r.method).statistics, &b = result_of(results, r.peer).statistics;
  const bool better = a.registration.rms_mm < b.registration.rms_mm && a.registration.rms_deg < b.registration.rms_deg;
  return a.lost <= b.lost && better ? "yes" : "NO";
}

std::string accuracy_line(const Comparison& c, const SpeedRequirement& r) {
  return format("  %-59s %11s %19s %19s\n", format("%s: more accurate than %s", r.method, r.peer).c_str(), "yes", compared(c.noise_free, r),
                compared(c.noisy, r));
}

std::string requirements(const Comparison& c) {
  constexpr const char* kColumns = "  %-59s %11s %9s %9s %9s %9s\n";
  std::string text = format(kColumns, "", "required", "noise-free", "", "noisy", "");
  text += format(kColumns, "", "", "in a row", "by turns", "in a row", "by turns");
  for (const SpeedRequirement& required : kSpeeds) text += speed_line(c, required);
  for (const char* name : {kHits, kSilhouettes}) text += tail_line(c, name);
  for (const SpeedRequirement& required : kSpeeds) text += accuracy_line(c, required);
  return text;
}

}  // namespace

std::string table_text(const Comparison& c) {
  std::string text =
      format("%s, scenario %s: %zu scans, each registered from the pose of one frame before. Processor time of one thread.\n",
             c.mission.c_str(), c.scenario.c_str(), c.scans);
  text += "Only ratios within one run hold: machine and load change the times (docs/benchmarks.md).\n\n";
  text += section("without noise", c.noise_free) + "\n" + section("with noise", c.noisy) + "\n";
  for (const char* name : {kHits, kSilhouettes}) text += bound_line(c.noisy, name);
  return text + "\n" + requirements(c);
}

}  // namespace lasso::bench
