// What a campaign shows of its criteria.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mdat/campaign/result_table.hpp"
#include "mdat/common/limits.hpp"
#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::mdat {

enum class Verdict : std::uint8_t { kMet = 0, kFailed = 1, kUndecided = 2 };
const char* to_string(Verdict verdict);

struct Conclusion {
  Criterion criterion;
  std::uint32_t cases = 0, within = 0;
  std::uint32_t not_run = 0, unknown = 0;  // outside, as they failed to run; as their figure is not a number (no valid pose: no error)
  bool sequence = false;                   // a rule stops the campaign
  Limits limits;                           // of the share: Clopper and Pearson's; with a rule those of a confidence sequence
  Verdict verdict = Verdict::kUndecided;
  std::optional<double> more;  // cases that would decide it if the share stays as it is; of an undecided one, where any number would
  double share() const { return cases == 0 ? 0 : static_cast<double>(within) / cases; }
};

// Is the figure of this case within the criterion's bounds? One that is not a number never is, nor that of a case that failed to run.
bool is_within(const Criterion& criterion, const CaseRow& row, std::size_t figure);

// Which of the table's figures a criterion is about. Throws InputError where there is none of its name.
std::size_t figure_of(const Criterion& criterion, const ResultTable& table);

// Of each criterion, in their order.
std::vector<Conclusion> conclude(const CampaignSource& campaign, const ResultTable& table);

// The stopping rule, which is asked with one case after the other, in the order of their numbers from 0. At each multiple of look_every it
// ends the campaign if every criterion is decided; without a criterion, never.
class StoppingRule {
 public:
  // `names`: a table with the campaign's figures. Throws as figure_of.
  StoppingRule(const CampaignSource& campaign, const ResultTable& names);
  // Whether the campaign ends with this case.
  bool ends_with(const CaseRow& row);

 private:
  std::uint32_t look_every_, cases_ = 0;
  std::vector<Conclusion> conclusions_;
  std::vector<std::size_t> figures_;  // of each conclusion
};

// The number of cases after which the stopping rule ends the campaign: the first multiple of look_every, counted in case numbers, at which
// every criterion is decided by the cases below. Nothing where there is no rule, no criterion, or where a case below is not yet there: it
// does not depend on who flew which case when.
std::optional<std::uint32_t> stop_at(const CampaignSource& campaign, const ResultTable& table);

}  // namespace lasso::mdat
