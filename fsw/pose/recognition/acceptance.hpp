// The acceptance test of a search: does its best pose rule out every other one?
#pragma once

#include <cstddef>

namespace lasso {

constexpr double kScoreAlone = 1.5;  // times the ratio asked for: the score alone tells
constexpr double kScoreAloneInDoubt = 3;
constexpr double kAgrees = 1.2;         // ratio of costs that are not alike
constexpr double kJoinedAgrees = 1.05;  // the same, where the scores of several scans tell
constexpr double kFair = 1.5;           // cost of what is explained, where something else is not
constexpr double kEven = 0.02;          // disagreement below which nothing is off but by the noise, or by the target's motion

// A pose more than 15 deg from the best one.
struct Competitor {
  double score_ratio = 0;  // its score over the best one's (SearchResult::ratio)
  bool weighed = false;    // costs are known
  double cost = 0;         // of its RegionCosts; the same of both poses
  double best_cost = 0;    // of the best pose's
  double best_explained_cost = 0;
  double best_disagreement = 0;
  std::size_t scans = 1;  // that the scores are of; costs are the last one's
};

// Scores are compared by this, of which 1 is alike.
double ratio_of(double score, double best);

// Its score alone does not tell: costs are asked for, and sooner where the best pose itself leaves returns unexplained.
bool is_near(double score_ratio, double best_cost, double ratio_min);

// A part of the target may be off, but what looks a little like the target is something else.
bool is_another_object(const Competitor& competitor);

// By its score, and not against what the returns' noise says; or by that alone, which tells near-symmetric poses apart that look alike
// within the score's tolerance. Never where the best pose leaves returns unexplained and does not explain the others as the noise allows,
// unless its score is far ahead. Where the scores of several scans agree that it is behind, costs have to agree less clearly.
bool is_outscored(const Competitor& competitor, double ratio_min);

}  // namespace lasso
