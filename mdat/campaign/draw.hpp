// What each case of a campaign draws: the values of its columns, by the laws of the mission.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mdat/campaign/unit_sampler.hpp"

namespace lasso::mdat {

struct CaseValues {
  std::uint64_t seed = 0;       // of its noise, below 2^32: no two cases of a campaign have the same
  std::vector<double> numbers;  // one a column, in the unit of its name
};

// Case k is the same alone and among all others: it depends on the campaign's seed and k (of a Latin hypercube, on the number of cases).
class CaseDraws {
 public:
  // Throws InputError, as UnitSampler.
  explicit CaseDraws(const CampaignSource& campaign);

  std::vector<std::string> columns() const;
  CaseValues values(std::uint32_t case_number) const;

 private:
  std::uint64_t seed_;
  std::vector<Dispersion> dispersions_;
  UnitSampler sampler_;
};

// The value at a share of the law, in (0, 1): the inverse of its distribution function.
double quantile_of(const NumberLaw& law, double share);

}  // namespace lasso::mdat
