// Whether the user of valid poses can rely on what they say: for how long wrong ones pass for valid, and what the covariance promises of
// the errors against what they are.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mdat/run/statistics.hpp"

namespace lasso::mdat {

struct Integrity {
  std::size_t wrong = 0;  // valid poses
  AlertStatistics alert;
  ProtectionStatistics protection;
  std::size_t flights = 0, wrong_flights = 0;  // of a campaign: all, and those with a wrong pose; 0: nothing is said of flights
};
Integrity integrity_of(const RunStatistics& run);

// {"time_to_alert": {...}, "protection": {...}}, keys as in docs/user-guide.md; what is not known is null.
nlohmann::ordered_json integrity_json(const Integrity& integrity);

// A table for the terminal and for pages: a row for each of what is named, `nothing` where there is nothing to say. Limits are Clopper and
// Pearson's at 95 %, of poses as if they were independent; of what there is none of, the upper one alone.
std::vector<std::string> integrity_head(const std::string& first);
std::vector<std::string> integrity_row(const std::string& name, const Integrity& integrity, const char* nothing);

// The same of one alone, and more: a name and a text each.
std::vector<std::vector<std::string>> integrity_list(const Integrity& integrity);

// What table and list mean, in sentences.
extern const char* const kIntegrityNote;

}  // namespace lasso::mdat
