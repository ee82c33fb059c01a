// The same cases flown under two missions, images or versions: what changed, and whether that is more than chance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mdat/campaign/result_table.hpp"
#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::mdat {

// A figure over the cases that have it in both, B - A.
struct PairedFigure {
  std::string name;
  std::uint32_t cases = 0, larger = 0, smaller = 0;  // in B
  double mean_a = 0, mean_b = 0;
  double difference = 0, half_width = 0;  // mean, and half of Student's interval of 95 %; not a number of fewer than two cases
  double probability = 1;                 // of so unequal numbers of larger and smaller by chance: sign test, exact, two-sided; Holm
};

// A criterion that both have by the same name and figure.
struct PairedCriterion {
  std::string name;
  std::uint32_t both = 0, neither = 0;        // cases within the bounds: A's in A, B's in B
  std::vector<std::uint32_t> only_a, only_b;  // numbers of the cases that changed sides
  double probability = 1;                     // of so unequal changes by chance: McNemar's test, exact, two-sided; Holm
};

struct Comparison {
  std::uint32_t cases = 0;  // in both
  std::uint32_t only_in_a = 0, only_in_b = 0;
  std::vector<PairedFigure> figures;
  std::vector<PairedCriterion> criteria;
};

// Cases are the same where they have the same number. Throws InputError where the campaigns have two seeds, so that the noise differs, or
// where a value that both draw differs in a case: then they are not the same cases. Probabilities are corrected by Holm, those of figures
// for the number of figures and those of criteria for the number of criteria.
Comparison compare_cases(const CampaignSource& campaign_a, const ResultTable& a, const CampaignSource& campaign_b, const ResultTable& b);

// For the terminal; `folder_a`, `folder_b` as commands name them.
std::string comparison_text(const Comparison& comparison, const std::string& folder_a, const std::string& folder_b);

// Two-sided, exact: `some` of `all` coin tosses, or a number as far from half.
double sign_test(std::uint32_t some, std::uint32_t all);

}  // namespace lasso::mdat
