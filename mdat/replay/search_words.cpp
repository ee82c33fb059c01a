#include "mdat/replay/search_words.hpp"

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

std::string score_text(const Competitor& rival) {
  return format("the best competitor (a pose more than 15 deg off) scores %.2f times as badly", rival.score_ratio);
}

std::string costs_text(const Competitor& rival) {
  return format("mean squared residuals in sigmas are %.2f of it and %.2f of the pose", rival.cost, rival.best_cost);
}

double alone_from(const Competitor& rival, double ratio_min) {
  return (rival.best_cost > kCleanCost ? kScoreAloneInDoubt : kScoreAlone) * ratio_min;
}

std::string accepted(const std::optional<Competitor>& rival, double ratio_min) {
  if (!rival) return "no competitor is left: no other pose more than 15 deg off explains the scan nearly as well";
  if (!is_near(rival->score_ratio, rival->best_cost, ratio_min)) {
    return score_text(*rival) + format(": more than %.3g is enough by itself", alone_from(*rival, ratio_min));
  }
  if (rival->score_ratio >= ratio_min) {
    return score_text(*rival) + format(": more than the least ratio %.3g", ratio_min) +
           (rival->weighed ? "; and the noise of the returns agrees: " + costs_text(*rival) : "");
  }
  return score_text(*rival) + format(": less than the least ratio %.3g; but the noise of the returns tells them apart: ", ratio_min) +
         costs_text(*rival);
}

std::string ambiguous(const std::optional<Competitor>& rival, double ratio_min) {
  if (!rival) return "a competitor is not excluded";
  const std::string score = score_text(*rival);
  if (is_another_object(*rival)) {
    return score + format(
                       ": less than %.3g; and the pose leaves %.0f %% unexplained and explains the rest worse than noise does (mean "
                       "squared residual "
                       "%.2f; up to %.3g is fair): it may be another object that looks a little like the target",
                       alone_from(*rival, ratio_min), 100 * rival->best_disagreement, rival->best_explained_cost, kFair);
  }
  if (rival->score_ratio < ratio_min) {
    return score + format(": less than the least ratio %.3g", ratio_min) +
           (rival->weighed ? "; and the noise of the returns does not tell them apart: " + costs_text(*rival) : "");
  }
  return score +
         format(": more than the least ratio %.3g; but less than %.3g; and the competitor explains the returns about as well: ", ratio_min,
                alone_from(*rival, ratio_min)) +
         costs_text(*rival);
}

}  // namespace

std::optional<Competitor> decisive_rival(const PoseSearch& search, double ratio_min) {
  std::optional<Competitor> best;
  for (std::size_t i = 0; i < search.poses(); ++i) {
    Competitor rival;
    if (!search.find_competitor(i, rival)) continue;
    const bool stands = !is_outscored(rival, ratio_min);
    const bool best_stands = best && !is_outscored(*best, ratio_min);
    if (!best || (stands && !best_stands) || (stands == best_stands && rival.score_ratio < best->score_ratio)) best = rival;
  }
  return best;
}

std::string search_words(const SearchResult& result, const std::optional<Competitor>& rival, const SearchLimits& limits) {
  switch (result.reason) {
    case SearchReason::kTooFewReturns:
      return format("%u returns are looked at; a search needs %.0f", result.returns, limits.hits_min);
    case SearchReason::kNotRegistered:
      return "the returns leave a direction of the best pose open";
    case SearchReason::kUnexplained:
      return format("the best pose leaves %.0f %% unexplained; an accepted one leaves at most %.0f %%", 100 * result.disagreement,
                    100 * limits.disagreement_max);
    case SearchReason::kUnfinished:
      return "its work was used up before every other pose was excluded";
    case SearchReason::kDistinct:
      return accepted(rival, limits.ratio_min);
    case SearchReason::kCompetitor:
      return ambiguous(rival, limits.ratio_min);
    case SearchReason::kNotDone:
      break;
  }
  return "there was nothing to search";
}

}  // namespace lasso::mdat
