// Scores as they are shown: a table for a person, JSON and a row a scan for programs.
#pragma once

#include <string>
#include <vector>

#include "mdat/benchmark/score.hpp"

namespace lasso::mdat {

constexpr double kScoreConfidence = 0.95;

// What the set is, in a line or two.
std::string set_text(const BenchmarkSet& set, const ScoreCounts& counts);

// A line a program: shares with their exact limits, NEES, times; then the worst body of each. All of one set.
std::string scores_text(const BenchmarkSet& set, const std::vector<Score>& scores);

// The same with all bodies. What is not known is null. Keys as in docs/benchmark-protocol.md.
std::string scores_json(const BenchmarkSet& set, const std::vector<Score>& scores);

// program,body,scan,determined,verdict,error_m,error_deg,squared: a row for each scan of each program.
std::string scores_csv(const std::vector<Score>& scores);

}  // namespace lasso::mdat
