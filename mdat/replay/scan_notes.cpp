#include "mdat/replay/scan_notes.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using sim::ScanFacts;

constexpr double kSameSpan = 1.2;  // a ratio: a column named t_s that is in another unit spans a scan all the same
constexpr double kMinute_s = 60;

struct Unit {
  double unit_s;
  const char* name;
};
constexpr Unit kUnits[] = {{1, "seconds"}, {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-9, "nanoseconds"}};

// Of the scans whose unit is not named; 0 where none has a span.
double median_span(const std::vector<ScanFacts>& facts) {
  std::vector<double> spans;
  for (const ScanFacts& scan : facts) {
    if (scan.has_times && !(scan.unit_s > 0) && scan.last_time > scan.first_time) spans.push_back(scan.last_time - scan.first_time);
  }
  if (spans.empty()) return 0;
  const auto middle = spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2);
  std::nth_element(spans.begin(), middle, spans.end());
  return *middle;
}

double seconds(const ScanFacts& scan, double time, double unit_s) { return time * (scan.unit_s > 0 ? scan.unit_s : unit_s); }

// "12 of 30 scans", or "all 30 scans".
std::string share(std::size_t count, std::size_t all) {
  if (all == 1) return "the scan";
  return count == all ? format("all %zu scans", all) : format("%zu of %zu scans", count, all);
}

template <class Is>
std::size_t count_if(const std::vector<ScanFacts>& facts, const Is& is) {
  return static_cast<std::size_t>(std::count_if(facts.begin(), facts.end(), is));
}

void add_unmeasured(const std::vector<ScanFacts>& facts, Notes& notes) {
  const std::size_t scans = count_if(facts, [](const ScanFacts& scan) { return scan.unmeasured > 0; });
  if (scans == 0) return;
  std::size_t unmeasured = 0, rows = 0;
  for (const ScanFacts& scan : facts) {
    unmeasured += scan.unmeasured;
    rows += scan.unmeasured + scan.hits + scan.misses;
  }
  notes.push_back(format("note: %zu of %zu rows have no measurement (NaN or zeros; in %s): they are left out, and are no misses",
                         unmeasured, rows, share(scans, facts.size()).c_str()));
}

void add_thinned(const std::vector<ScanFacts>& facts, Notes& notes) {
  const auto is_thinned = [](const ScanFacts& scan) { return scan.kept_hits < scan.hits || scan.kept_misses < scan.misses; };
  const std::size_t scans = count_if(facts, is_thinned);
  if (scans == 0) return;
  const ScanFacts& largest = *std::max_element(
      facts.begin(), facts.end(), [](const ScanFacts& a, const ScanFacts& b) { return a.hits + a.misses < b.hits + b.misses; });
  std::string text = format("note: %s thinned to %zu rays: of the largest %zu of %zu returns are taken, spread over the target",
                            share(scans, facts.size()).c_str(), kMaxRays, largest.kept_hits, largest.hits);
  if (largest.misses > 0) text += format(", and %zu of %zu misses, those around them", largest.kept_misses, largest.misses);
  notes.push_back(text);
}

// Each of them with the place where it comes first.
void add_warnings(const std::vector<ScanFacts>& facts, Notes& notes) {
  std::vector<std::string> told;
  for (const ScanFacts& scan : facts) {
    for (const sim::ScanWarning& warning : scan.warnings) {
      if (std::find(told.begin(), told.end(), warning.text) != told.end()) continue;
      told.push_back(warning.text);
      const auto is_same = [&](const sim::ScanWarning& other) { return other.text == warning.text; };
      const auto warned = [&](const ScanFacts& of) { return std::any_of(of.warnings.begin(), of.warnings.end(), is_same); };
      notes.push_back("warning: " + warning.place + ": " + warning.text + " (warned of " + share(count_if(facts, warned), facts.size()) +
                      ")");
    }
  }
}

void add_directions(const std::vector<ScanFacts>& facts, Notes& notes) {
  const std::size_t scans = count_if(facts, [](const ScanFacts& scan) { return scan.directions > 0; });
  if (scans == 0) return;
  std::size_t directions = 0, hits = 0;
  for (const ScanFacts& scan : facts) {
    directions += scan.directions;
    hits += scan.hits;
  }
  notes.push_back(
      format("warning: %zu of %zu returns have the length 1, as directions have (in %s): they are read as returns; leave rays that missed "
             "out of a cloud, or write them into a CSV file with valid 0",
             directions, hits, share(scans, facts.size()).c_str()));
}

// By the ratio of a span in it to the mission's.
const Unit& closest_unit(double span, double duration_s) {
  const auto off = [&](const Unit& unit) { return std::abs(std::log(span * unit.unit_s / duration_s)); };
  return *std::min_element(std::begin(kUnits), std::end(kUnits), [&](const Unit& a, const Unit& b) { return off(a) < off(b); });
}

bool is_same_span(double span_s, double other_s) { return std::abs(std::log(span_s / other_s)) <= std::log(kSameSpan); }

Notes kept_seconds_note(double span, double duration_s) {
  if (!(span > 0)) return {};
  if (is_same_span(kMinute_s * span, duration_s)) {
    return {format(
        "warning: the scans' times are taken as seconds: a scan spans %g of them, and the mission's takes %g s (scan.duration_s): in "
        "minutes? --time-unit min reads them so",
        span, duration_s)};
  }
  if (closest_unit(span, duration_s).unit_s == 1) return {};
  return {
      format("warning: the scans' times are taken as seconds, as their column t_s says: a scan spans %g s, and the mission's takes %g s "
             "(scan.duration_s); --time-unit says otherwise",
             span, duration_s)};
}

}  // namespace

double time_unit_s(const std::vector<ScanFacts>& facts, double duration_s) {
  const double span = median_span(facts);
  if (!(span > 0)) return 1;
  const double unit_s = closest_unit(span, duration_s).unit_s;
  const bool same = is_same_span(span * unit_s, duration_s);
  const bool named = count_if(facts, [](const ScanFacts& scan) { return scan.seconds_named; }) > 0;
  return named && !same ? 1 : unit_s;
}

Notes time_unit_note(const std::vector<ScanFacts>& facts, double duration_s, double unit_s) {
  const auto unit = std::find_if(std::begin(kUnits), std::end(kUnits), [&](const Unit& known) { return known.unit_s == unit_s; });
  if (unit == std::end(kUnits)) return {};
  if (unit == std::begin(kUnits)) return kept_seconds_note(median_span(facts), duration_s);
  return {format(
      "note: the scans' times are taken as %s: a scan spans %g of them, and the mission's takes %g s (scan.duration_s); --time-unit says "
      "otherwise",
      unit->name, median_span(facts), duration_s)};
}

Notes mixed_unit_notes(const sim::RecordedScans& scans, const std::vector<ScanFacts>& facts, double unit_s) {
  const double usual = median_span(facts);
  std::size_t others = 0, first = 0;
  double between = 0;  // units of the others in one of the first
  for (std::size_t i = 0; i < facts.size() && usual > 0; ++i) {
    const double span = facts[i].last_time - facts[i].first_time;
    if (!facts[i].has_times || facts[i].unit_s > 0 || !(span > 0)) continue;
    for (const double ratio : {1e-9, 1e-6, 1e-3, 1 / kMinute_s, kMinute_s, 1e3, 1e6, 1e9}) {
      if (!is_same_span(span, usual * ratio)) continue;
      if (others++ == 0) first = i, between = ratio;
    }
  }
  if (others == 0) return {};
  return {format(
      "warning: the times of %s seem to be in another unit than the others': %s spans %g, about %g times their %g; they are all read as "
      "units of %g s",
      share(others, facts.size()).c_str(), scans.stem(first).c_str(), facts[first].last_time - facts[first].first_time, between, usual,
      unit_s)};
}

Notes row_notes(const std::vector<ScanFacts>& facts) {
  Notes notes;
  add_warnings(facts, notes);
  add_directions(facts, notes);
  add_unmeasured(facts, notes);
  add_thinned(facts, notes);
  const std::size_t turned = count_if(facts, [](const ScanFacts& scan) { return scan.viewpoint; });
  if (turned > 0) {
    notes.push_back(
        format("note: VIEWPOINT of %s: points are taken to the axes of the sensor that stood there", share(turned, facts.size()).c_str()));
  }
  return notes;
}

Notes order_notes(const sim::RecordedScans& scans, const std::vector<ScanFacts>& facts, double unit_s) {
  std::size_t timed = 0, back = 0, first = 0, before = 0;
  for (std::size_t i = 1; i < facts.size(); ++i) {
    if (!facts[i].has_times || !facts[i - 1].has_times) continue;
    ++timed;
    if (!(seconds(facts[i], facts[i].first_time, unit_s) < seconds(facts[i - 1], facts[i - 1].last_time, unit_s))) continue;
    if (back++ == 0) first = i;
    before += seconds(facts[i], facts[i].last_time, unit_s) <= seconds(facts[i - 1], facts[i - 1].first_time, unit_s) ? 1U : 0U;
  }
  if (back == 0) return {};
  const double begin_s = seconds(facts[first], facts[first].first_time, unit_s);
  const double before_s = seconds(facts[first - 1], facts[first - 1].last_time, unit_s);
  if (before == timed && timed > 1) {
    return {
        format("warning: each scan ends before the one before it begins (%s: begins at %.6f s, and %s ends at %.6f s): the order of the "
               "files' names is that of time reversed. They are registered in that order; in closed loop they follow each other by the "
               "mission's period: name them anew",
               scans.stem(first).c_str(), begin_s, scans.stem(first - 1).c_str(), before_s)};
  }
  if (back == timed && timed > 1) {
    return {
        format("warning: the times of each scan begin before the scan before it ends (%s: at %.6f s, after %.6f s): as if each began anew; "
               "in closed loop they follow each other by the mission's period",
               scans.stem(first).c_str(), begin_s, before_s)};
  }
  return {
      format("warning: times step back at %zu of %zu scans, first at %s, which begins at %.6f s, after %s, which ends at %.6f s: is the "
             "order of "
             "the files' names that of time? They are registered in that order",
             back, facts.size(), scans.stem(first).c_str(), begin_s, scans.stem(first - 1).c_str(), before_s)};
}

}  // namespace lasso::mdat
