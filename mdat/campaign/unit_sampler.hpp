// Points of a unit cube, a point a case, from which the values of the case are drawn. Integers alone decide their bits, so that they are
// the same everywhere. A point depends on the seed, the case and the dimension alone; in a Latin hypercube on the number of cases, too.
#pragma once

#include <boost/random/sobol.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "mdat/missiondb/campaign_source.hpp"

namespace lasso::mdat {

// 64 bits of a stream at a place, as if drawn at random: three rounds of the finalizer of splitmix64 (Steele, Lea, Flood, 2014).
std::uint64_t hash(std::uint64_t seed, std::uint64_t stream, std::uint64_t place);

// Where `index` of [0, size) goes in a random permutation: a Feistel network on the next power of 4, walked until the result is below
// `size`, which takes less than four steps on average. size <= 2^32.
std::uint64_t permuted(std::uint64_t index, std::uint64_t size, std::uint64_t key);

class UnitSampler {
 public:
  // Throws InputError: more dimensions than kMostSobolDimensions of a Sobol sequence.
  UnitSampler(Sampling sampling, std::uint64_t seed, std::uint32_t cases, std::size_t dimensions);

  // One number a dimension, in (0, 1), of a case in [0, cases). kRandom: independent. kLatinHypercube: of the `cases` strata of a dimension
  // each holds one case, anywhere in it. kSobol: Joe's and Kuo's sequence, its bits turned over in each dimension as the seed says (a
  // digital shift), so that any two seeds differ and no number is 0.
  std::vector<double> point(std::uint32_t case_number) const;

 private:
  double random(std::uint32_t case_number, std::size_t dimension) const;
  double stratified(std::uint32_t case_number, std::size_t dimension) const;
  std::vector<double> quasi_random(std::uint32_t case_number) const;

  Sampling sampling_;
  std::uint64_t seed_;
  std::uint32_t cases_;
  std::size_t dimensions_;
  std::optional<boost::random::sobol> sobol_;
};

constexpr std::size_t kMostSobolDimensions = 3667;  // of the tables of Boost.Random

}  // namespace lasso::mdat
