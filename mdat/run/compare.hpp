// Two results side by side.
#pragma once

#include <string>

namespace lasso::mdat {

// What a run left, by the name that the user gave it: a folder, or its results.json.
struct NamedResults {
  std::string name, json;
};
NamedResults load_results(const std::string& name);  // throws InputError

// A table for a person: the settings that differ, then for each variant errors, counts, NEES and times, and B over A. Throws InputError
// that names the one that is no result of mdat run.
std::string comparison_text(const NamedResults& a, const NamedResults& b);

}  // namespace lasso::mdat
