// All that is said of a campaign's results, on the terminal, in the report and in files for machines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mdat/campaign/causes.hpp"
#include "mdat/campaign/conclusion.hpp"
#include "mdat/run/integrity.hpp"

namespace lasso::mdat {

// The table with a column for the length of each vector that it has two or three components of (`.x`, `.y`, `.z`), named
// "|truth.spin_degps|": what depends on how long a vector is does not show in its components, as both signs are alike.
ResultTable with_lengths(ResultTable table);

struct Finding {
  Conclusion conclusion;
  std::size_t figure = 0;                 // its column in the table
  std::vector<std::size_t> worst;         // rows of the table
  std::vector<Correlation> correlations;  // the strongest first
};

struct Findings {
  const CampaignSource& campaign;
  ResultTable table;                   // with the lengths of vectors that were drawn, behind the columns
  std::string folder;                  // of the campaign, as commands name it
  std::uint32_t not_run = 0;           // cases that failed to run
  bool stopped = false;                // by its rule, before all cases were flown
  std::vector<Finding> findings;       // a criterion each
  std::optional<Integrity> integrity;  // of all cases; nothing where their counts were not kept
  bool complete() const { return stopped || table.rows.size() >= campaign.cases; }
};

// What there is to say of one conclusion: at most ten worst cases.
Finding finding_of(const Conclusion& conclusion, const ResultTable& table);

// Of each criterion. `campaign` is referred to.
Findings find(const CampaignSource& campaign, const ResultTable& table, const std::string& folder);

// Of all cases of the table together; medians of levels to within 4.5 %. Nothing where it has no counts.
std::optional<Integrity> integrity_of(const ResultTable& table);

// The command that flies a case again: a shell reads it.
std::string case_command(const Findings& all, std::uint32_t number);

// What makes a case bad, for a person: "rms_mm 41.2", "no rms_mm".
std::string case_text(const Findings& all, const Finding& finding, std::size_t row);

// Why a case failed to run: its status without the word.
std::string reason_text(const CaseRow& row);

// Rows of cases that failed to run, in the order of their numbers; at most `most`.
std::vector<std::size_t> failed_cases(const ResultTable& table, std::size_t most);

// "500 cases", "150 of at most 500 cases, as every criterion is decided"; with those that failed to run.
std::string cases_text(const Findings& all);

}  // namespace lasso::mdat
