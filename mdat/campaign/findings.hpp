// All that is said of a campaign's results, on the terminal, in the report and in files for machines.
#pragma once

#include <string>
#include <vector>

#include "mdat/campaign/causes.hpp"
#include "mdat/campaign/conclusion.hpp"

namespace lasso::mdat {

struct Finding {
  Conclusion conclusion;
  std::size_t figure = 0;                 // its column in the table
  std::vector<std::size_t> worst;         // rows of the table
  std::vector<Correlation> correlations;  // the strongest first
};

struct Findings {
  const CampaignSource& campaign;
  const ResultTable& table;
  std::string folder;             // of the campaign, as commands name it
  std::uint32_t not_run = 0;      // cases that failed to run
  bool stopped = false;           // by its rule, before all cases were flown
  std::vector<Finding> findings;  // a criterion each
};

// `campaign` and `table` are referred to. At most ten worst cases each.
Findings find(const CampaignSource& campaign, const ResultTable& table, const std::string& folder);

// The command that flies a case again: a shell reads it.
std::string case_command(const Findings& all, std::uint32_t number);

// What makes a case bad, for a person: "rms_mm 41.2", "no rms_mm", "failed: REASON".
std::string case_text(const Findings& all, const Finding& finding, std::size_t row);

// "500 cases", "150 of at most 500 cases, as every criterion is decided"; with those that failed to run.
std::string cases_text(const Findings& all);

}  // namespace lasso::mdat
