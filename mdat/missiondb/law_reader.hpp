// The law of one number as a mission file writes it: 0.5, { uniform = [0, 1] }, { one_of = [1, 2], weights = [3, 1] }. Inside of missiondb.
#pragma once

#include <optional>
#include <string>

#include "mdat/missiondb/campaign_source.hpp"
#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// What the law can draw lies in the row's range, a normal one's tails too: without `within` it may reach 4 sigma at most, and is cut off
// at the range. Otherwise a problem under the name `key`. Of a list's row, the law of one of its numbers.
std::optional<NumberLaw> read_law(const toml::node& node, ValueRow row, const std::string& key, ProblemList& problems);

// The least and the largest number that the law draws, of a normal one at 4 sigma.
struct Span {
  double low, high;
};
Span span_of(const NumberLaw& law);

// How far a normal law reaches, in sigmas: beyond lie 63 of a million.
constexpr double kReach = 4;

// "reaches from -0.07 to 0.17 (mean and 4 sigma)"
std::string reach_text(double mean, double sigma);

// Six digits.
std::string rounded_text(double value);

}  // namespace lasso::mdat
