#include "mdat/campaign/causes.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "mdat/campaign/conclusion.hpp"
#include "mdat/common/double_policy.hpp"

namespace lasso::mdat {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Places 0, 1, ... in the order that `before` says of two of them; equal ones stay as they are.
template <class Before>
std::vector<std::size_t> sorted_places(std::size_t count, const Before& before) {
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), 0);
  std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return before(a, b) || (!before(b, a) && a < b); });
  return places;
}

std::vector<double> badness_of_all(const Criterion& criterion, const ResultTable& table, std::size_t figure) {
  std::vector<double> values;
  for (const CaseRow& row : table.rows) values.push_back(badness(criterion, row, figure));
  return values;
}

std::vector<double> column_of(const ResultTable& table, std::size_t column) {
  std::vector<double> values;
  for (const CaseRow& row : table.rows) values.push_back(row.drawn[column]);
  return values;
}

}  // namespace

double badness(const Criterion& criterion, const CaseRow& row, std::size_t figure) {
  if (!row.has_run() || std::isnan(row.figures[figure])) return kInfinity;
  const double value = row.figures[figure];
  const double beyond = std::max(criterion.at_least - value, value - criterion.at_most);
  return beyond == -kInfinity ? value : beyond;
}

std::vector<std::size_t> worst_cases(const Criterion& criterion, const ResultTable& table, std::size_t figure, std::size_t most) {
  const std::vector<double> bad = badness_of_all(criterion, table, figure);
  std::vector<std::size_t> places = sorted_places(bad.size(), [&](std::size_t a, std::size_t b) { return bad[a] > bad[b]; });
  std::erase_if(places, [&](std::size_t row) { return !table.rows[row].has_run(); });
  if (places.empty()) return places;
  const double best = bad[places.back()];
  const auto matters = [&](std::size_t row) { return bad[row] > best || !is_within(criterion, table.rows[row], figure); };
  const auto end = std::find_if_not(places.begin(), places.end(), matters);
  places.erase(std::min(end, places.begin() + static_cast<std::ptrdiff_t>(std::min(most, places.size()))), places.end());
  return places;
}

std::vector<double> average_ranks(const std::vector<double>& values) {
  const auto places = sorted_places(values.size(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, last = 0; first < places.size(); first = last) {
    while (last < places.size() && values[places[last]] == values[places[first]]) ++last;
    for (std::size_t i = first; i < last; ++i) ranks[places[i]] = static_cast<double>(first + last + 1) / 2;
  }
  return ranks;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = average_ranks(a), y = average_ranks(b);
  const double mean = (static_cast<double>(a.size()) + 1) / 2;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean) * (x[i] - mean);
    xy += (x[i] - mean) * (y[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xy / std::sqrt(xx * yy);
}

double two_sided_probability(double correlation, std::size_t count) {
  if (count < 3) return 1;
  const auto pairs = static_cast<double>(count);
  const double least = 2 / std::tgamma(pairs + 1), left = 1 - correlation * correlation;
  if (left <= 0) return least;
  const double t = std::abs(correlation) * std::sqrt((pairs - 2) / left);
  return std::max(least,
                  2 * boost::math::cdf(boost::math::complement(boost::math::students_t_distribution<double, DoublePolicy>(pairs - 2), t)));
}

std::vector<double> holm(const std::vector<double>& probabilities) {
  const std::size_t count = probabilities.size();
  std::vector<double> adjusted(count);
  double least = 0;
  const auto places = sorted_places(count, [&](std::size_t a, std::size_t b) { return probabilities[a] < probabilities[b]; });
  for (std::size_t i = 0; i < count; ++i) {
    least = std::max(least, std::min(1.0, static_cast<double>(count - i) * probabilities[places[i]]));
    adjusted[places[i]] = least;
  }
  return adjusted;
}

std::vector<Correlation> correlations(const Criterion& criterion, const ResultTable& table, std::size_t figure) {
  const std::vector<double> bad = badness_of_all(criterion, table, figure);
  std::vector<Correlation> found;
  std::vector<double> probabilities;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const double rho = rank_correlation(column_of(table, column), bad);
    if (std::isnan(rho)) continue;
    found.push_back({column, rho, 1});
    probabilities.push_back(two_sided_probability(rho, bad.size()));
  }
  const std::vector<double> adjusted = holm(probabilities);
  for (std::size_t i = 0; i < found.size(); ++i) found[i].probability = adjusted[i];
  const auto stronger = [](const Correlation& a, const Correlation& b) {
    return std::abs(a.rho) != std::abs(b.rho) ? std::abs(a.rho) > std::abs(b.rho) : a.column < b.column;
  };
  std::sort(found.begin(), found.end(), stronger);
  return found;
}

}  // namespace lasso::mdat
