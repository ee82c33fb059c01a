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

}  // namespace lasso::test
