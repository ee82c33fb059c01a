#include "mdat/missiondb/campaign_rules.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/missiondb/campaign_columns.hpp"
#include "mdat/missiondb/law_reader.hpp"
#include "mdat/missiondb/mission_checks.hpp"
#include "mdat/missiondb/rule.hpp"

namespace lasso::mdat {
namespace {

using Numbers = std::vector<double>;

// Values of a dispersion's columns: the middle first, then its ends.
struct Corners {
  std::vector<Numbers> operator()(const NumberLaw& law) const {
    const Span span = span_of(law);
    const double middle = std::holds_alternative<OneOf>(law) ? span.low : 0.5 * (span.low + span.high);
    return {{middle}, {span.low}, {span.high}};
  }
  std::vector<Numbers> operator()(const AnyDirection& law) const {
    const Span span = span_of(law.length);
    return {{0.5 * (span.low + span.high), 0, 0}, {span.high, 0, 0}, {0, span.high, 0}, {0, 0, span.high}};
  }
  std::vector<Numbers> operator()(const AnyAttitude&) const { return {{0, 0, 0}}; }
  // Where one number is 4 sigma off, the others as is then most likely.
  std::vector<Numbers> operator()(const Correlated& law) const {
    std::vector<Numbers> corners{law.mean};
    const std::size_t size = law.mean.size();
    for (std::size_t i = 0; i < 2 * size; ++i) {
      const std::size_t at = i / 2;
      const double reach = (i % 2 == 0 ? kReach : -kReach) / std::sqrt(law.covariance[at * size + at]);
      Numbers corner = law.mean;
      for (std::size_t j = 0; j < size; ++j) corner[j] += reach * law.covariance[j * size + at];
      corners.push_back(corner);
    }
    return corners;
  }
  std::vector<Numbers> operator()(const Rows& law) const {
    constexpr std::size_t kMostRows = 100;
    std::vector<Numbers> corners;
    for (std::size_t row = 0; row < std::min(kMostRows, law.values.size() / columns); ++row) {
      const auto first = law.values.begin() + static_cast<std::ptrdiff_t>(row * columns);
      corners.emplace_back(first, first + static_cast<std::ptrdiff_t>(columns));
    }
    return corners;
  }
  std::size_t columns = 1;
};

std::vector<Numbers> corners_of(const Dispersion& dispersion) { return std::visit(Corners{dispersion.columns.size()}, dispersion.law); }

void set_columns(Scenario& scenario, const Dispersion& dispersion, const Numbers& values) {
  for (std::size_t i = 0; i < values.size(); ++i) set_column(scenario, dispersion.columns[i], values[i]);
}

std::string values_text(const Dispersion& dispersion, const Numbers& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += (i == 0 ? "with " : ", ") + dispersion.columns[i] + " = " + rounded_text(values[i]);
  return text;
}

bool has_column(const CampaignSource& campaign, const std::vector<std::string>& names, const Dispersion*& found) {
  for (const Dispersion& dispersion : campaign.dispersions) {
    found = &dispersion;
    const auto is_one = [&](const std::string& column) { return std::find(names.begin(), names.end(), column) != names.end(); };
    if (std::any_of(dispersion.columns.begin(), dispersion.columns.end(), is_one)) return true;
  }
  return false;
}

class CampaignCheck {
 public:
  CampaignCheck(MissionSource& source, const CampaignSource& campaign, ProblemList& problems)
      : source_(source), campaign_(campaign), problems_(problems), scenario_(source.scenarios.at(campaign.scenario)), trial_(source) {
    trial_.campaigns.clear();  // their tables may be large
    if (campaign.frames > 0) scenario_.frames = campaign.frames;
  }

  void run() {
    check_looks();
    check_criteria();
    check_scenario();
    check_ranges();
    for (const Dispersion& dispersion : campaign_.dispersions) {
      check_effect(dispersion);
      check_rows(dispersion);
    }
    if (problems_.empty()) check_corners();
  }

 private:
  void complain(const std::string& key, const std::string& value, const std::string& why) {
    problems_.add(source_.origins[key], key, value, why);
  }

  void check_looks() {
    if (campaign_.look_every == 0) return;
    const std::string key = "campaign." + campaign_.name + ".look_every", value = std::to_string(campaign_.look_every);
    if (campaign_.look_every > campaign_.cases) complain(key, value, "expected at most cases, which is " + std::to_string(campaign_.cases));
    if (campaign_.sampling != Sampling::kRandom)
      complain(key, value, "goes with sampling = \"random\" alone: the first cases of other samplings do not stand for all");
  }

  void check_criteria() {
    constexpr double kSettling = 20;  // frames after which a figure "settled_..." begins
    for (const Criterion& criterion : campaign_.criteria) {
      if (criterion.figure.rfind("settled_", 0) != 0 || scenario_.frames > kSettling) continue;
      complain("campaign." + campaign_.name + ".criteria." + criterion.name + ".figure", criterion.figure,
               "is of the frames after the first 20, and a case has " + number_text(scenario_.frames) + ": write more frames");
    }
    if (campaign_.look_every > 0 && campaign_.criteria.empty())
      complain("campaign." + campaign_.name + ".look_every", std::to_string(campaign_.look_every),
               "has nothing to decide: add [campaign." + campaign_.name + ".criteria.NAME], or delete it");
  }

  void check_scenario() {
    const Dispersion* found = nullptr;
    if (scenario_.has_profile() && has_column(campaign_, {"truth.range_m"}, found))
      complain(found->key, "truth.range_m",
               "scenario " + campaign_.scenario +
                   (scenario_.scene != nullptr
                        ? " flies the mission's nodes, whose motions say where the target is: choose a scenario with ranges_m"
                        : " flies a profile of ranges at times_s: vary offset_m, or choose a scenario without times_s"));
    if (scenario_.drawn != 0 && has_column(campaign_, attitude_columns(), found))
      complain(found->key, "", "changes nothing: scenario " + campaign_.scenario + " draws its attitude itself; write drawn = false in it");
  }

  void check_ranges() {
    if (scenario_.has_profile() || scenario_.ranges_m.size() < 2) return;
    const Dispersion* found = nullptr;
    if (has_column(campaign_, {"truth.range_m"}, found)) return;
    source_.warnings.push_back(
        to_string(problem_at(source_, "campaign." + campaign_.name + ".scenario", campaign_.scenario,
                             "has " + std::to_string(scenario_.ranges_m.size()) + " ranges, of which a case flies the first, " +
                                 number_text(scenario_.ranges_m.front()) + " m: give truth.range_m a law, such as { one_of = [...] }")));
  }
  void warn(const Dispersion& dispersion, const std::string& value, const std::string& what) {
    source_.warnings.push_back(to_string(problem_at(source_, dispersion.key, value, what)));
  }
  void check_effect(const Dispersion& dispersion) {
    for (const std::string& column : dispersion.columns) {
      const bool simulated = column.rfind("truth.", 0) == 0;
      if (!simulated || has_effect(scenario_, find_column(column)->row.key)) continue;
      warn(dispersion, column, "has no effect in scenario " + campaign_.scenario);
    }
  }
  void check_rows(const Dispersion& dispersion) {
    const Rows* rows = std::get_if<Rows>(&dispersion.law);
    if (rows == nullptr || !rows->in_order) return;
    check_order(dispersion, *rows);
    const std::size_t count = rows->values.size() / dispersion.columns.size();
    if (count >= campaign_.cases) return;
    warn(dispersion, rows->file,
         "has " + std::to_string(count) + " rows for " + std::to_string(campaign_.cases) +
             " cases: after the last they are flown again, with other seeds");
  }

  // A table is mostly sorted: its first rows do not stand for all.
  void check_order(const Dispersion& dispersion, const Rows& rows) {
    if (campaign_.look_every == 0) return;
    complain(dispersion.key, rows.file,
             "in order does not go with look_every: the first rows do not stand for all; write rows = \"drawn\", or delete look_every");
  }

  // From a possible case, with its middle of each law, to the ends of one law at a time.
  void check_corners() {
    for (const Dispersion& dispersion : campaign_.dispersions) set_columns(scenario_, dispersion, corners_of(dispersion).front());
    for (const Dispersion& dispersion : campaign_.dispersions) {
      for (const Numbers& values : corners_of(dispersion)) {
        if (keeps_rules(dispersion, values)) continue;
        if (values == corners_of(dispersion).front()) return;  // the middle of all laws
        break;
      }
    }
  }
  bool keeps_rules(const Dispersion& dispersion, const Numbers& values) {
    trial_.scenarios = {{campaign_.scenario, scenario_}};
    set_columns(trial_.scenarios[campaign_.scenario], dispersion, values);
    const std::vector<Problem> broken = check_rules(trial_, nullptr);
    trial_.doubts.clear();
    if (!broken.empty()) {
      const Problem& first = broken.front();
      complain(dispersion.key, values_text(dispersion, values), "contradicts " + first.key + ": " + first.value + ": " + first.expected);
    }
    return broken.empty();
  }

  MissionSource& source_;
  const CampaignSource& campaign_;
  ProblemList& problems_;
  Scenario scenario_;
  MissionSource trial_;
};

}  // namespace

void check_campaigns(MissionSource& source, ProblemList& problems) {
  for (const auto& [name, campaign] : source.campaigns) CampaignCheck(source, campaign, problems).run();
}

}  // namespace lasso::mdat
