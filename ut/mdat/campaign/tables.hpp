// Campaigns and their results, for tests.
#pragma once

#include <limits>
#include <vector>

#include "mdat/campaign/result_table.hpp"
#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

inline mdat::Criterion at_most(const char* name, const char* figure, double bound, double share_min) {
  return {name, figure, -kInfinite, bound, share_min, 0.95};
}

// One figure and one drawn value a case.
inline mdat::ResultTable table_of(const std::vector<double>& figures) {
  mdat::ResultTable table{{"rms_mm"}, {"truth.range_m"}, {}};
  for (const double figure : figures) {
    const auto number = static_cast<std::uint32_t>(table.rows.size());
    table.rows.push_back({number, "ok", {figure}, {2 + 0.01 * number}});
  }
  return table;
}

// So many of so many are within a bound of 1.
inline mdat::ResultTable table_with(std::size_t within, std::size_t cases) {
  std::vector<double> figures(within, 0.5);
  figures.resize(cases, 3);
  return table_of(figures);
}

inline mdat::CampaignSource campaign_of(const std::vector<mdat::Criterion>& criteria) {
  mdat::CampaignSource campaign;
  campaign.name = "rough";
  campaign.scenario = "spin";
  campaign.criteria = criteria;
  return campaign;
}

// A campaign of 40 cases with two criteria: one is met, one fails where the range is large; a case fails to run, one has no figure.
struct MixedCampaign {
  mdat::CampaignSource campaign = campaign_of({at_most("no_wrong_pose", "wrong", 0, 0.8), at_most("precise", "rms_mm", 4, 0.9)});
  mdat::ResultTable table{{"wrong", "rms_mm"}, {"truth.range_m", "truth.spin_degps.x"}, {}};
  MixedCampaign() {
    campaign.cases = 40;
    for (std::uint32_t number = 0; number < 40; ++number) {
      const double range_m = 2 + 0.1 * number;
      table.rows.push_back({number, "ok", {0, range_m}, {range_m, (7 * number) % 40 * 0.1}});
    }
    table.rows[3] = {3, "failed:worker ended, by \"signal\" 11", {kNoNumber, kNoNumber}, {2.3, 2.1}};
    table.rows[5].figures[1] = kNoNumber;
  }
};

// Three flights of 100 valid poses each: one has a wrong pose for 0.4 s, one two misleading poses, one none of either; and a case that
// failed to run.
inline mdat::ResultTable table_with_counts() {
  mdat::ResultTable table{{"wrong", "misleading", "level_worst_mm", "level_worst_deg"}, {"truth.range_m"}, {}};
  table.rows = {{0, "ok", {2, 0, 7, 0.5}, {2}}, {1, "ok", {0, 2, 9, 0.25}, {3}}, {2, "ok", {0, 0, 5, 0.1}, {4}}};
  table.rows.push_back({3, "failed:refused", {kNoNumber, kNoNumber, kNoNumber, kNoNumber}, {5}});
  mdat::CaseCounts counts;
  counts.alert.add(mdat::WrongEpisode{1, 0.4, false});
  for (int i = 0; i < 300; ++i) {
    counts.position_m.add(0.004, i < 2 ? 0.005 : 0.001);
    counts.attitude_rad.add(0.001, 0.0002);
  }
  table.counts = counts;
  return table;
}

}  // namespace lasso::test
