#include "mdat/campaign/conclusion.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/campaign/sequence.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMostCases = 1e9;  // more are not worth a number

Limits limits_of(bool sequence, double within, double cases, double confidence) {
  return sequence ? share_sequence(within, cases, confidence) : share_limits(within, cases, confidence);
}

Verdict verdict_of(const Limits& limits, double share_min) {
  if (limits.lower >= share_min) return Verdict::kMet;
  return limits.upper < share_min ? Verdict::kFailed : Verdict::kUndecided;
}

// The least number of cases, of which this share is within, that decides: the limits close in as it grows. Nothing where more than
// kMostCases would be needed, as the share is the one that is asked for.
std::optional<double> deciding_cases(const Conclusion& conclusion) {
  const double share = conclusion.share(), cases = conclusion.cases;
  const Criterion& criterion = conclusion.criterion;
  const auto decides = [&](double number) {
    return verdict_of(limits_of(conclusion.sequence, share * number, number, criterion.confidence), criterion.share_min) !=
           Verdict::kUndecided;
  };
  double low = cases, high = std::max(1.0, 2 * cases);
  while (!decides(high)) {
    if (high > kMostCases) return std::nullopt;
    low = high;
    high *= 2;
  }
  while (high - low > 1) {
    const double middle = std::floor((low + high) / 2);
    (decides(middle) ? high : low) = middle;
  }
  return high;
}

void count(const Criterion& criterion, const CaseRow& row, std::size_t figure, Conclusion& conclusion) {
  ++conclusion.cases;
  if (!row.has_run())
    ++conclusion.not_run;
  else if (std::isnan(row.figures[figure]))
    ++conclusion.unknown;
  else if (is_within(criterion, row, figure))
    ++conclusion.within;
}

void decide(Conclusion& conclusion) {
  conclusion.limits = limits_of(conclusion.sequence, conclusion.within, conclusion.cases, conclusion.criterion.confidence);
  conclusion.verdict = verdict_of(conclusion.limits, conclusion.criterion.share_min);
}

}  // namespace

const char* to_string(Verdict verdict) {
  constexpr const char* kNames[] = {"met", "failed", "undecided"};
  return kNames[static_cast<std::size_t>(verdict)];
}

bool is_within(const Criterion& criterion, const CaseRow& row, std::size_t figure) {
  return row.has_run() && row.figures[figure] >= criterion.at_least && row.figures[figure] <= criterion.at_most;
}

std::size_t figure_of(const Criterion& criterion, const ResultTable& table) {
  const auto place = std::find(table.figures.begin(), table.figures.end(), criterion.figure);
  if (place != table.figures.end()) return static_cast<std::size_t>(place - table.figures.begin());
  std::string known;
  for (const std::string& name : table.figures) known += (known.empty() ? "" : ", ") + name;
  throw InputError("criterion " + criterion.name + ": a case has no figure " + criterion.figure + "; it has " + known);
}

std::vector<Conclusion> conclude(const CampaignSource& campaign, const ResultTable& table) {
  std::vector<Conclusion> conclusions;
  for (const Criterion& criterion : campaign.criteria) {
    Conclusion& conclusion = conclusions.emplace_back();
    conclusion.criterion = criterion;
    conclusion.sequence = campaign.look_every > 0;
    for (const CaseRow& row : table.rows) count(criterion, row, figure_of(criterion, table), conclusion);
    decide(conclusion);
    if (conclusion.verdict != Verdict::kUndecided || criterion.share_min >= 1 || conclusion.cases == 0) continue;
    const auto cases = deciding_cases(conclusion);
    if (cases) conclusion.more = *cases - conclusion.cases;
  }
  return conclusions;
}

StoppingRule::StoppingRule(const CampaignSource& campaign, const ResultTable& names) : look_every_(campaign.look_every) {
  for (const Criterion& criterion : campaign.criteria) {
    Conclusion& conclusion = conclusions_.emplace_back();
    conclusion.criterion = criterion;
    conclusion.sequence = true;
    figures_.push_back(figure_of(criterion, names));
  }
}

bool StoppingRule::ends_with(const CaseRow& row) {
  for (std::size_t i = 0; i < conclusions_.size(); ++i) count(conclusions_[i].criterion, row, figures_[i], conclusions_[i]);
  if (look_every_ == 0 || ++cases_ % look_every_ != 0 || conclusions_.empty()) return false;
  for (Conclusion& conclusion : conclusions_) decide(conclusion);
  return std::none_of(conclusions_.begin(), conclusions_.end(), [](const Conclusion& one) { return one.verdict == Verdict::kUndecided; });
}

std::optional<std::uint32_t> stop_at(const CampaignSource& campaign, const ResultTable& table) {
  if (campaign.look_every == 0) return std::nullopt;
  StoppingRule rule(campaign, table);
  for (std::uint32_t number = 0; number < table.rows.size() && table.rows[number].number == number; ++number)
    if (rule.ends_with(table.rows[number])) return number + 1;
  return std::nullopt;
}

}  // namespace lasso::mdat
