#include "mdat/campaign/unit_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/distributions.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// By dimensions.
std::vector<std::vector<double>> columns_of(const UnitSampler& sampler, std::uint32_t cases, std::size_t dimensions) {
  std::vector<std::vector<double>> columns(dimensions);
  for (std::uint32_t k = 0; k < cases; ++k) {
    const std::vector<double> point = sampler.point(k);
    for (std::size_t d = 0; d < dimensions; ++d) columns[d].push_back(point.at(d));
  }
  return columns;
}

// How many of the numbers are in each of equal parts of (0, 1).
std::vector<int> counts_of(const std::vector<double>& numbers, std::size_t parts) {
  std::vector<int> counts(parts);
  for (const double u : numbers) ++counts.at(static_cast<std::size_t>(u * static_cast<double>(parts)));
  return counts;
}

// The first number of splitmix64 of seed 0, as published, three times.
TEST(UnitSampler, TheHashIsTheFinalizerOfSplitmix64) {
  VERIFIES("LASSO-GND-046~1");
  constexpr std::uint64_t kFirst = 0xE220A8397B1DCDAFU;
  EXPECT_EQ(hash(0, kFirst, kFirst), kFirst);
}

TEST(UnitSampler, RandomPointsAreUniformAndIndependent) {
  VERIFIES("LASSO-GND-047~1");
  constexpr std::uint32_t kCases = 4000;
  const auto columns = columns_of(UnitSampler(Sampling::kRandom, 5, kCases, 3), kCases, 3);
  const auto next = columns_of(UnitSampler(Sampling::kRandom, 6, kCases, 1), kCases, 1);
  for (const auto& column : columns) {
    EXPECT_LT(ks_distance(column, [](double u) { return u; }), ks_limit(kCases));
    EXPECT_LT(std::fabs(correlation(column, next[0])), 4 / std::sqrt(kCases)) << "of another seed";
  }
  EXPECT_LT(std::fabs(correlation(columns[0], columns[1])), 4 / std::sqrt(kCases));
  std::vector<double> later(columns[0].begin() + 1, columns[0].end());
  later.push_back(columns[0][0]);
  EXPECT_LT(std::fabs(correlation(columns[0], later)), 4 / std::sqrt(kCases)) << "of the next case";
}

TEST(UnitSampler, APointDependsOnItsCaseAlone) {
  VERIFIES("LASSO-GND-046~1");
  for (const Sampling sampling : {Sampling::kRandom, Sampling::kSobol}) {
    const UnitSampler few(sampling, 3, 20, 4), many(sampling, 3, 1000000, 4);
    const std::vector<double> last = many.point(999999);
    EXPECT_EQ(few.point(17), many.point(17));
    EXPECT_EQ(many.point(999999), last) << "whatever was asked for before";
  }
  EXPECT_EQ(UnitSampler(Sampling::kRandom, 3, 20, 4).point(17)[1], UnitSampler(Sampling::kRandom, 3, 20, 2).point(17)[1]);
}

TEST(UnitSampler, PermutationsTakeEachPlaceOnce) {
  VERIFIES("LASSO-GND-048~1");
  for (std::uint64_t size = 1; size < 80; ++size) {
    std::vector<int> taken(size);
    for (std::uint64_t i = 0; i < size; ++i) ++taken.at(permuted(i, size, 9));
    EXPECT_EQ(taken, std::vector<int>(size, 1)) << size;
  }
}

TEST(UnitSampler, EachStratumOfALatinHypercubeHoldsOneCase) {
  VERIFIES("LASSO-GND-048~1");
  for (const std::uint32_t cases : {1U, 2U, 7U, 1000U}) {
    const auto columns = columns_of(UnitSampler(Sampling::kLatinHypercube, 11, cases, 3), cases, 3);
    for (const auto& column : columns) EXPECT_EQ(counts_of(column, cases), std::vector<int>(cases, 1)) << cases;
  }
  const auto columns = columns_of(UnitSampler(Sampling::kLatinHypercube, 11, 1000, 2), 1000, 2);
  EXPECT_LT(std::fabs(correlation(columns[0], columns[1])), 4 / std::sqrt(1000));
  std::vector<double> within;
  for (const double u : columns[0]) within.push_back(1000 * u - std::floor(1000 * u));
  EXPECT_LT(ks_distance(within, [](double u) { return u; }), ks_limit(1000)) << "anywhere in its stratum";
}

TEST(UnitSampler, TheLargestLatinHypercubeStaysBelowOne) {
  VERIFIES("LASSO-GND-048~1");
  constexpr std::uint32_t kCases = 10000000;
  const UnitSampler sampler(Sampling::kLatinHypercube, 1, kCases, 1);
  for (std::uint32_t k = 0; k < 20000; ++k) {
    const double u = sampler.point(k)[0];
    ASSERT_GT(u, 0);
    ASSERT_LT(u, 1);
  }
}

// (0, m, 1)-nets: the first 2^k points are equally many in each dyadic interval of each dimension, whatever the shift.
TEST(UnitSampler, SobolPointsBalance) {
  VERIFIES("LASSO-GND-048~1");
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto columns = columns_of(UnitSampler(Sampling::kSobol, seed, 256, 20), 256, 20);
    for (const auto& column : columns) {
      for (std::size_t parts = 2; parts <= 256; parts *= 2)
        EXPECT_EQ(counts_of(column, parts), std::vector<int>(parts, static_cast<int>(256 / parts)));
    }
  }
  EXPECT_NE(UnitSampler(Sampling::kSobol, 1, 9, 2).point(3), UnitSampler(Sampling::kSobol, 2, 9, 2).point(3)) << "seeds differ";
}

// Of a product of five linear factors, whose mean is 1, the error of 1024 points: well below that of as many random ones, 0.04.
TEST(UnitSampler, SobolPointsIntegrateBetterThanRandomOnes) {
  VERIFIES("LASSO-GND-048~1");
  const UnitSampler sampler(Sampling::kSobol, 4, 1024, 5);
  double sum = 0;
  for (std::uint32_t k = 0; k < 1024; ++k) {
    double product = 1;
    for (const double u : sampler.point(k)) product *= 0.5 + u;
    sum += product;
  }
  EXPECT_NEAR(sum / 1024, 1, 0.002);
}

TEST(UnitSampler, TooManyDimensionsForSobolAreRefused) {
  VERIFIES("LASSO-GND-048~1");
  EXPECT_THROW(UnitSampler(Sampling::kSobol, 1, 10, kMostSobolDimensions + 1), InputError);
  EXPECT_TRUE(UnitSampler(Sampling::kSobol, 1, 10, 0).point(3).empty());
}

}  // namespace
}  // namespace lasso::mdat
