// What a campaign has found out: a row a case.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mdat/campaign/case_counts.hpp"

namespace lasso::mdat {

struct CaseRow {
  std::uint32_t number = 0;  // from 0
  std::string status;        // "ok"; of a case that failed to run "failed:REASON", and its figures are not numbers
  std::vector<double> figures, drawn;
  bool has_run() const { return status == "ok"; }
};

struct ResultTable {
  std::vector<std::string> figures, columns;  // names of a row's figures, and of what was drawn for it
  std::vector<CaseRow> rows;                  // by ascending case number
  std::optional<CaseCounts> counts = {};      // of all rows; nothing where the mdat that flew them kept none
};

}  // namespace lasso::mdat
