// Why a search accepts its best pose or not, in words.
#pragma once

#include <optional>
#include <string>

#include "fsw/pose/recognition/pose_search.hpp"

namespace lasso::mdat {

// The competitor that decided: of those that are not left behind, else of all, the one with the best score. `search` is done.
std::optional<Competitor> decisive_rival(const PoseSearch& search, double ratio_min);

// One sentence without commas: the rule that decided, with its figures and limits.
std::string search_words(const SearchResult& result, const std::optional<Competitor>& rival, const SearchLimits& limits);

}  // namespace lasso::mdat
