// Which cases of a campaign are the worst, and what they have in common.
#pragma once

#include <cstddef>
#include <vector>

#include "mdat/campaign/result_table.hpp"
#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::mdat {

// How far a case is beyond the nearer bound of a criterion, negative inside, the figure itself where there is no bound: the larger the
// worse. Infinite of a case that failed to run and of a figure that is not a number. `figure` is the criterion's column.
double badness(const Criterion& criterion, const CaseRow& row, std::size_t figure);

// Rows of the table, the worst first, equal ones in the order of their numbers; at most `most`. None that
// failed to run; of cases within the bounds only those that are worse than the best of all.
std::vector<std::size_t> worst_cases(const Criterion& criterion, const ResultTable& table, std::size_t figure, std::size_t most);

// Ranks from 1; equal values have the mean of theirs.
std::vector<double> average_ranks(const std::vector<double>& values);

// Spearman's rank correlation, from -1 to 1; not a number where one of them does not vary. As many of both.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

// Probability of a correlation at least as far from 0 among `count` pairs that have nothing to do with each other: Student's t with count -
// 2 degrees of freedom, but no less than 2 / count!, which is exact for the most extreme order. 1 of fewer than three pairs.
double two_sided_probability(double correlation, std::size_t count);

// The same of several questions asked at once, each no less than its own, so that the chance of any false finding stays at the level that
// they are compared with (Holm, Scandinavian Journal of Statistics 6, 1979). In the order of the given ones.
std::vector<double> holm(const std::vector<double>& probabilities);

struct Correlation {
  std::size_t column = 0;  // of the table's drawn values
  double rho = 0;          // positive: cases are worse where the value is larger
  double probability = 1;  // after Holm, over all columns that vary
};
constexpr double kSignificance = 0.05;

// Of the columns with the badness of cases, the strongest first. Columns that do not vary are left out; none where the badness does not.
std::vector<Correlation> correlations(const Criterion& criterion, const ResultTable& table, std::size_t figure);

}  // namespace lasso::mdat
