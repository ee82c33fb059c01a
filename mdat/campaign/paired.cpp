#include "mdat/campaign/paired.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "mdat/campaign/causes.hpp"
#include "mdat/campaign/conclusion.hpp"
#include "mdat/campaign/summary_text.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr double kConfidence = 0.95;
constexpr std::size_t kShownChanges = 10;

struct CasePair {
  const CaseRow* a;
  const CaseRow* b;
};
using CasePairs = std::vector<CasePair>;

// Where a column of one is in the other; its size where it is not.
std::size_t place_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

constexpr char kNotTheSame[] =
    ": these are not the same cases; give both campaigns the same seed, sampling, number of cases and order of laws";

void require_same_seed(const CampaignSource& a, const CampaignSource& b) {
  if (a.seed == b.seed) return;
  throw InputError(format("the seed is %llu in A and %llu in B%s", static_cast<unsigned long long>(a.seed),
                          static_cast<unsigned long long>(b.seed), kNotTheSame));
}

void require_same_draws(const CasePair& pair, const ResultTable& a, const ResultTable& b) {
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    const std::size_t other = place_of(b.columns, a.columns[i]);
    if (other == b.columns.size() || pair.a->drawn[i] == pair.b->drawn[other]) continue;
    throw InputError(format("case %u has %s = %.9g in A and %.9g in B%s", pair.a->number, a.columns[i].c_str(), pair.a->drawn[i],
                            pair.b->drawn[other], kNotTheSame));
  }
}

CasePairs pairs_of(const ResultTable& a, const ResultTable& b) {
  CasePairs pairs;
  auto row_b = b.rows.begin();
  for (const CaseRow& row_a : a.rows) {
    while (row_b != b.rows.end() && row_b->number < row_a.number) ++row_b;
    if (row_b == b.rows.end() || row_b->number != row_a.number) continue;
    pairs.push_back({&row_a, &*row_b});
    require_same_draws(pairs.back(), a, b);
  }
  return pairs;
}

// Mean and half of its interval, by Student's t.
void set_interval(const std::vector<double>& differences, PairedFigure& figure) {
  const double n = static_cast<double>(differences.size());
  double sum = 0, squares = 0;
  for (const double value : differences) sum += value;
  figure.difference = sum / n;
  for (const double value : differences) squares += (value - figure.difference) * (value - figure.difference);
  figure.half_width = std::numeric_limits<double>::quiet_NaN();
  if (differences.size() < 2) return;
  const double t = boost::math::quantile(boost::math::students_t(n - 1), 0.5 + kConfidence / 2);
  figure.half_width = t * std::sqrt(squares / (n - 1) / n);
}

PairedFigure paired_figure(const std::string& name, const CasePairs& pairs, std::size_t in_a, std::size_t in_b) {
  PairedFigure figure;
  figure.name = name;
  std::vector<double> differences;
  for (const CasePair& pair : pairs) {
    const double a = pair.a->figures[in_a], b = pair.b->figures[in_b];
    if (std::isnan(a) || std::isnan(b)) continue;
    differences.push_back(b - a);
    figure.mean_a += a;
    figure.mean_b += b;
    figure.larger += b > a ? 1U : 0U;
    figure.smaller += b < a ? 1U : 0U;
  }
  figure.cases = static_cast<std::uint32_t>(differences.size());
  if (differences.empty()) return figure;
  figure.mean_a /= figure.cases;
  figure.mean_b /= figure.cases;
  set_interval(differences, figure);
  figure.probability = sign_test(figure.larger, figure.larger + figure.smaller);
  return figure;
}

PairedCriterion paired_criterion(const Criterion& of_a, std::size_t in_a, const Criterion& of_b, std::size_t in_b, const CasePairs& pairs) {
  PairedCriterion result;
  result.name = of_a.name;
  for (const CasePair& pair : pairs) {
    const bool a = is_within(of_a, *pair.a, in_a), b = is_within(of_b, *pair.b, in_b);
    if (a == b) {
      ++(a ? result.both : result.neither);
    } else {
      (a ? result.only_a : result.only_b).push_back(pair.a->number);
    }
  }
  const auto changes_a = static_cast<std::uint32_t>(result.only_a.size()), changes_b = static_cast<std::uint32_t>(result.only_b.size());
  result.probability = sign_test(changes_b, changes_a + changes_b);
  return result;
}

// That of the same name and figure; nullptr if there is none.
const Criterion* counterpart(const Criterion& of_a, const CampaignSource& campaign) {
  const auto is_it = [&](const Criterion& of_b) { return of_a.name == of_b.name && of_a.figure == of_b.figure; };
  const auto found = std::find_if(campaign.criteria.begin(), campaign.criteria.end(), is_it);
  return found == campaign.criteria.end() ? nullptr : &*found;
}

// Corrects the probabilities of several questions, each figure's or criterion's, that are asked at once.
template <class One>
void correct_by_holm(std::vector<One>& all) {
  std::vector<double> probabilities;
  for (const One& one : all) probabilities.push_back(one.probability);
  const std::vector<double> corrected = holm(probabilities);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].probability = corrected[i];
}

std::string interval_text(const PairedFigure& figure) {
  return std::isnan(figure.half_width) ? format("%+.4g", figure.difference) : format("%+.4g +- %.2g", figure.difference, figure.half_width);
}

std::string figures_text(const Comparison& comparison) {
  std::vector<std::vector<std::string>> lines = {
      {"figure", "cases", "mean A", "mean B", "B - A (95 %)", "larger, smaller", "sign test, Holm"}};
  for (const PairedFigure& one : comparison.figures) {
    if (one.cases == 0) continue;
    lines.push_back({one.name, std::to_string(one.cases), format("%.4g", one.mean_a), format("%.4g", one.mean_b), interval_text(one),
                     format("%u, %u", one.larger, one.smaller), probability_text(one.probability)});
  }
  return aligned_text(lines);
}

std::string changes_text(const std::vector<std::uint32_t>& cases, const char* what, const std::string& folder) {
  if (cases.empty()) return "";
  std::string text = format("  %s: case", what);
  for (std::size_t i = 0; i < std::min(cases.size(), kShownChanges); ++i) text += format(i == 0 ? " %u" : ", %u", cases[i]);
  if (cases.size() > kShownChanges) text += format(" and %zu more", cases.size() - kShownChanges);
  return text + format("; mdat campaign case %s %u\n", shell_word(folder).c_str(), cases.front());
}

std::string criterion_changes(const PairedCriterion& one, const std::string& folder_a, const std::string& folder_b) {
  const std::size_t changed = one.only_a.size() + one.only_b.size();
  return format("%s: within in both %u, in neither %u; changed sides %zu%s\n", one.name.c_str(), one.both, one.neither, changed,
                changed == 0 ? "" : (" (McNemar, Holm: " + probability_text(one.probability) + ")").c_str()) +
         changes_text(one.only_a, "within in A alone", folder_b) + changes_text(one.only_b, "within in B alone", folder_a);
}

}  // namespace

double sign_test(std::uint32_t some, std::uint32_t all) {
  if (all == 0) return 1;
  const boost::math::binomial coin(all, 0.5);
  return std::min(1.0, 2 * boost::math::cdf(coin, std::min(some, all - some)));
}

Comparison compare_cases(const CampaignSource& campaign_a, const ResultTable& a, const CampaignSource& campaign_b, const ResultTable& b) {
  require_same_seed(campaign_a, campaign_b);
  const CasePairs pairs = pairs_of(a, b);
  Comparison comparison;
  comparison.cases = static_cast<std::uint32_t>(pairs.size());
  comparison.only_in_a = static_cast<std::uint32_t>(a.rows.size()) - comparison.cases;
  comparison.only_in_b = static_cast<std::uint32_t>(b.rows.size()) - comparison.cases;
  for (std::size_t i = 0; i < a.figures.size(); ++i) {
    const std::size_t other = place_of(b.figures, a.figures[i]);
    if (other < b.figures.size()) comparison.figures.push_back(paired_figure(a.figures[i], pairs, i, other));
  }
  for (const Criterion& of_a : campaign_a.criteria) {
    if (const Criterion* of_b = counterpart(of_a, campaign_b))
      comparison.criteria.push_back(paired_criterion(of_a, figure_of(of_a, a), *of_b, figure_of(*of_b, b), pairs));
  }
  correct_by_holm(comparison.figures);
  correct_by_holm(comparison.criteria);
  return comparison;
}

std::string comparison_text(const Comparison& comparison, const std::string& folder_a, const std::string& folder_b) {
  std::string text = "A: " + folder_a + "\nB: " + folder_b + format("\n%u cases in both", comparison.cases);
  if (comparison.only_in_a + comparison.only_in_b > 0)
    text += format("; %u in A alone and %u in B alone are left out", comparison.only_in_a, comparison.only_in_b);
  text += "\n\n" + figures_text(comparison) + "\n";
  for (const PairedCriterion& one : comparison.criteria) text += criterion_changes(one, folder_a, folder_b);
  if (comparison.criteria.empty()) text += "No criterion has the same name and figure in both.\n";
  return text;
}

}  // namespace lasso::mdat
