#include "mdat/campaign/unit_sampler.hpp"

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;

// Streams of numbers of one dimension, for each of its uses.
enum class Use : std::uint64_t { kValue, kPermutation, kJitter, kShift };
constexpr std::uint64_t kUses = 4;
std::uint64_t stream_of(std::size_t dimension, Use use) { return kUses * dimension + static_cast<std::uint64_t>(use); }

std::uint64_t mixed(std::uint64_t x) {
  x += kGolden;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

// The middle of one of 2^`Bits` equal parts of (0, 1), by the first bits; exact.
template <int Bits>
double middle_of_part(std::uint64_t bits) {
  static_assert(Bits <= 52);
  return static_cast<double>(2 * (bits >> (64 - Bits)) + 1) / static_cast<double>(std::uint64_t{1} << (Bits + 1));
}

int half_bits(std::uint64_t size) {
  int bits = 1;
  while (bits < 16 && (std::uint64_t{1} << (2 * bits)) < size) ++bits;
  return bits;
}

std::uint64_t feistel(std::uint64_t value, int half, std::uint64_t key) {
  constexpr std::uint64_t kRounds = 6;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  std::uint64_t left = value >> half, right = value & mask;
  for (std::uint64_t round = 0; round < kRounds; ++round) {
    const std::uint64_t next = left ^ (hash(key, round, right) & mask);
    left = right;
    right = next;
  }
  return left << half | right;
}

}  // namespace

std::uint64_t hash(std::uint64_t seed, std::uint64_t stream, std::uint64_t place) { return mixed(mixed(mixed(seed) ^ stream) ^ place); }

std::uint64_t permuted(std::uint64_t index, std::uint64_t size, std::uint64_t key) {
  const int half = half_bits(size);
  do {
    index = feistel(index, half, key);
  } while (index >= size);
  return index;
}

UnitSampler::UnitSampler(Sampling sampling, std::uint64_t seed, std::uint32_t cases, std::size_t dimensions)
    : sampling_(sampling), seed_(seed), cases_(cases), dimensions_(dimensions) {
  if (sampling != Sampling::kSobol || dimensions == 0) return;
  if (dimensions > kMostSobolDimensions)
    throw InputError("sampling = \"sobol\" has " + std::to_string(kMostSobolDimensions) + " dimensions, and the campaign draws " +
                     std::to_string(dimensions) + " numbers a case: write \"latin_hypercube\" or \"random\"");
  sobol_.emplace(dimensions);
}

std::vector<double> UnitSampler::point(std::uint32_t case_number) const {
  if (sobol_) return quasi_random(case_number);
  std::vector<double> result;
  for (std::size_t d = 0; d < dimensions_; ++d) {
    result.push_back(sampling_ == Sampling::kLatinHypercube ? stratified(case_number, d) : random(case_number, d));
  }
  return result;
}

double UnitSampler::random(std::uint32_t case_number, std::size_t dimension) const {
  return middle_of_part<52>(hash(seed_, stream_of(dimension, Use::kValue), case_number));
}

// The sum is exact below 2^24 cases, so that its quotient is in the stratum, and below 1.
double UnitSampler::stratified(std::uint32_t case_number, std::size_t dimension) const {
  const std::uint64_t stratum = permuted(case_number, cases_, hash(seed_, stream_of(dimension, Use::kPermutation), 0));
  const double within = middle_of_part<28>(hash(seed_, stream_of(dimension, Use::kJitter), case_number));
  return (static_cast<double>(stratum) + within) / cases_;
}

// Boost begins after the origin, without which 2^k cases would not balance; shifted, it is a point like any other. Gray code seeks without
// drawing what is before.
std::vector<double> UnitSampler::quasi_random(std::uint32_t case_number) const {
  if (!sobol_) return {};  // of another sampling, or without dimensions
  boost::random::sobol sequence = *sobol_;
  if (case_number > 0) sequence.seed(case_number - 1);
  std::vector<double> result;
  for (std::size_t d = 0; d < dimensions_; ++d) {
    const std::uint64_t bits = case_number > 0 ? sequence() : 0;
    result.push_back(middle_of_part<52>(bits ^ hash(seed_, stream_of(d, Use::kShift), 0)));
  }
  return result;
}

}  // namespace lasso::mdat
