#include "ft/bodies/tally.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mdat/common/limits.hpp"
#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"

namespace lasso::bodies {
namespace {

using mdat::format;

double share(std::size_t part, std::size_t whole) { return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole); }

// "12 of 3456 (0.35 %, 0.18 to 0.61 %)": with the limits that hold at 95 %, as if each were independent of the others.
std::string share_text(std::size_t part, std::size_t whole) {
  if (whole == 0) return "0 of 0";
  const mdat::Limits limits = mdat::share_limits(static_cast<double>(part), static_cast<double>(whole), 0.95);
  return format("%zu of %zu (%.3g %%, %.3g to %.3g %%)", part, whole, 100 * share(part, whole), 100 * limits.lower, 100 * limits.upper);
}

double at_rank(std::vector<double> values, double rank) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(rank * static_cast<double>(values.size() - 1)))];
}

std::string reasons_text(const std::map<std::string, std::size_t>& reasons, const char* between) {
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [reason, count] : reasons) sorted.emplace_back(count, reason);
  std::sort(sorted.rbegin(), sorted.rend());
  std::string text;
  for (const auto& [count, reason] : sorted) text += (text.empty() ? "" : between) + format("%s %zu", reason.c_str(), count);
  return text;
}

// What there is to do about a body, most first: wrong poses, then determined ones that are not valid, then a covariance that is not honest.
bool is_worse(const Row& a, const Row& b) {
  const auto valid = [](const Tally& t) { return share(t.settled_valid, t.settled_determined); };
  return std::make_tuple(b.tally.wrong, valid(a.tally), b.tally.nees, a.seed) <
         std::make_tuple(a.tally.wrong, valid(b.tally), a.tally.nees, b.seed);
}

std::string worst_line(const Row& row) {
  const Tally& t = row.tally;
  return format(
      "  %5llu %-16s %6.3g m %-6s wrong %4zu in %2zu, valid %5.1f %% of %4zu determined (%5.1f %% once settled), NEES %8.3g  %s\n",
      static_cast<unsigned long long>(row.seed), row.kind.c_str(), row.size_m, row.sensor.c_str(), t.wrong, t.wrong_numbers,
      100 * share(t.determined_valid, t.determined), t.determined, 100 * share(t.settled_valid, t.settled_determined), t.nees,
      reasons_text(t.reasons, ", ").c_str());
}

struct Sums {
  std::size_t numbers = 0, trials = 0, valid = 0, determined = 0, determined_valid = 0, settled_determined = 0, settled_valid = 0,
              among = 0;
  std::size_t wrong = 0, wrong_numbers = 0, wrong_bodies = 0, below = 0, failed = 0, unknowable_wrong = 0, misleading = 0;
  mdat::AlertTimes alert;
  std::vector<double> nees;
  std::map<std::string, std::size_t> reasons;

  void add(const Row& row) {
    const Tally& t = row.tally;
    failed += row.failure.empty() ? 0U : 1U;
    numbers += t.numbers;
    trials += t.trials;
    valid += t.valid;
    determined += t.determined;
    determined_valid += t.determined_valid;
    settled_determined += t.settled_determined;
    settled_valid += t.settled_valid;
    among += t.among;
    wrong += t.wrong;
    wrong_numbers += t.wrong_numbers;
    wrong_bodies += t.wrong > 0 ? 1U : 0U;
    misleading += t.misleading;
    alert.add(t.alert);
    unknowable_wrong += row.knowable ? 0 : t.wrong;
    below += share(t.determined_valid, t.determined) < 0.9 ? 1U : 0U;
    if (t.valid > 0) nees.push_back(t.nees);
    for (const auto& [reason, count] : t.reasons) reasons[reason] += count;
  }
};

// Of flights alone: single scans have no time to alert.
std::string alert_line(const mdat::AlertStatistics& alert, std::size_t valid) {
  if (alert.episodes == 0)
    return "  time to alert:         no wrong pose, at most " +
           mdat::upper_limit_text(mdat::upper_share_limit(0, static_cast<double>(valid), 0.95)) + " of valid ones\n";
  return format("  time to alert:         median %.3g s, 95 %% %.3g s, worst %s%.3g s of ", alert.median_s, alert.p95_s,
                alert.worst_is_censored ? ">= " : "", alert.worst_s) +
         mdat::amount(alert.episodes, "episode") + format(", %zu of which the flight's end cut\n", alert.censored);
}

// A line for each kind of body.
std::string kinds_text(const std::vector<Row>& rows) {
  std::map<std::string, std::pair<std::size_t, Sums>> kinds;
  for (const Row& row : rows) {
    auto& [count, sums] = kinds[row.kind];
    ++count;
    sums.add(row);
  }
  std::string text = "by kind:\n";
  for (const auto& [kind, each] : kinds) {
    const auto& [count, sums] = each;
    text += format("  %-16s %3zu bodies, wrong %5zu of %6zu in %3zu of %4zu, %2zu bodies; valid %5.1f %% of %6zu determined (%5.1f %%)\n",
                   kind.c_str(), count, sums.wrong, sums.trials, sums.wrong_numbers, sums.numbers, sums.wrong_bodies,
                   100 * share(sums.determined_valid, sums.determined), sums.determined,
                   100 * share(sums.settled_valid, sums.settled_determined));
  }
  return text;
}

}  // namespace

void Tally::add(const Trial& trial, double size_m) {
  ++trials;
  determined += trial.determined ? 1U : 0U;
  determined_valid += trial.determined && trial.valid ? 1U : 0U;
  settled_determined += trial.determined && trial.settled ? 1U : 0U;
  settled_valid += trial.determined && trial.settled && trial.valid ? 1U : 0U;
  among += trial.determined && !trial.valid && trial.among ? 1U : 0U;
  if (trial.determined && !trial.valid) ++reasons[trial.reason];
  if (!trial.valid) return;
  ++valid;
  nees += (trial.error.squared - nees) / static_cast<double>(valid);
  worst = std::max(worst, trial.error.squared);
  misleading += trial.is_misleading() ? 1U : 0U;
  if (!trial.is_wrong(size_m)) return;
  ++wrong;
  if (wrong_trials.empty() || wrong_trials.back().number != trial.number) ++wrong_numbers;
  wrong_trials.push_back(trial);
}

Row row_of(const Subject& subject) {
  Row row;
  row.seed = subject.body.seed;
  row.kind = mdat::body_kind_name(subject.body.kind);
  row.what = subject.body.what;
  row.size_m = subject.truth.size_m;
  row.sensor = subject.mission.source.sensor == mdat::SensorKind::kLaserCamera ? "laser" : "lidar";
  row.symmetry = mdat::symmetry_text(subject.truth.symmetry);
  row.knowable = subject.truth.determined();
  return row;
}

std::string table_csv(const std::vector<Row>& rows) {
  std::string text =
      "seed,kind,size_m,sensor,knowable,numbers,trials,valid,determined,determined_valid,settled_determined,settled_valid,among,wrong,"
      "wrong_numbers,episodes,censored,time_to_alert_worst_s,misleading,nees,worst,reasons,symmetry,what,failure\n";
  for (const Row& row : rows) {
    const Tally& t = row.tally;
    const mdat::AlertStatistics alert = t.alert.statistics();
    text += format("%llu,%s,%.4g,%s,%d,%zu,%zu,%zu,%zu,%zu,%zu,%zu,%zu,%zu,%zu,%zu,%zu,%.6g,%zu,%.6g,%.6g,%s,\"%s\",\"%s\",\"%s\"\n",
                   static_cast<unsigned long long>(row.seed), row.kind.c_str(), row.size_m, row.sensor.c_str(), row.knowable ? 1 : 0,
                   t.numbers, t.trials, t.valid, t.determined, t.determined_valid, t.settled_determined, t.settled_valid, t.among, t.wrong,
                   t.wrong_numbers, alert.episodes, alert.censored, alert.episodes == 0 ? 0 : alert.worst_s, t.misleading, t.nees, t.worst,
                   reasons_text(t.reasons, "; ").c_str(), row.symmetry.c_str(), row.what.c_str(), row.failure.c_str());
  }
  return text;
}

std::string again_text(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    for (const std::string& command : row.tally.again) text += command + "\n";
  }
  return text;
}

std::string wrong_csv(const std::vector<Row>& rows) {
  std::string text = "seed,number,frame,range_m,determined,squared,translation_m,rotation_deg,sigma_m,sigma_deg\n";
  for (const Row& row : rows) {
    for (const Trial& t : row.tally.wrong_trials)
      text += format("%llu,%zu,%zu,%.4g,%d,%.4g,%.4g,%.4g,%.4g,%.4g\n", static_cast<unsigned long long>(row.seed), t.number, t.frame,
                     t.range_m, t.determined ? 1 : 0, t.error.squared, t.error.translation_m, t.error.rotation_rad / kRadPerDeg, t.sigma_m,
                     t.sigma_rad / kRadPerDeg);
  }
  return text;
}

std::string summary_text(const std::string& what, const std::vector<Row>& rows) {
  constexpr std::size_t kShown = 12;
  Sums sums;
  for (const Row& row : rows) sums.add(row);
  std::vector<Row> worst = rows;
  std::sort(worst.begin(), worst.end(), is_worse);
  std::string text = "worst bodies:\n";
  for (std::size_t i = 0; i < std::min(kShown, worst.size()); ++i) text += worst_line(worst[i]);
  text += kinds_text(rows);
  text += format("%s of %zu bodies, %zu of which were not tried:\n", what.c_str(), rows.size(), sums.failed);
  text += "  valid:                 " + share_text(sums.valid, sums.trials) + "\n";
  text += "  valid and wrong:       " + share_text(sums.wrong, sums.trials) + "; in " + share_text(sums.wrong_numbers, sums.numbers) +
          format(", of %zu bodies; %zu of bodies that cannot be known\n", sums.wrong_bodies, sums.unknowable_wrong);
  if (what == "track") text += alert_line(sums.alert.statistics(), sums.valid);
  text += "  misleading:            " + share_text(sums.misleading, sums.valid) + " of the valid ones exceed their protection level\n";
  text +=
      "  determined and valid:  " + share_text(sums.determined_valid, sums.determined) + format("; %zu bodies below 90 %%\n", sums.below);
  text += "  once settled:          " + share_text(sums.settled_valid, sums.settled_determined) + "\n";
  if (sums.among > 0) text += "  or among candidates:   " + share_text(sums.determined_valid + sums.among, sums.determined) + "\n";
  text += "  determined, not valid: " + reasons_text(sums.reasons, ", ") + "\n";
  text += format("  NEES of bodies:        median %.3g; from %.3g to %.3g in 90 %% of %zu\n", at_rank(sums.nees, 0.5),
                 at_rank(sums.nees, 0.05), at_rank(sums.nees, 0.95), sums.nees.size());
  return text;
}

}  // namespace lasso::bodies
