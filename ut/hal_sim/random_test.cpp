#include "hal_sim/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

TEST(Random, SplitMixGivesThePublishedSequence) {
  VERIFIES("LASSO-SIM-001~1");
  std::uint64_t state = 1234567;
  EXPECT_EQ(split_mix64(state), 6457827717110365317ULL);
  EXPECT_EQ(split_mix64(state), 3203168211198807973ULL);
  EXPECT_EQ(split_mix64(state), 9817491932198370423ULL);
  EXPECT_EQ(split_mix64(state), 4593380528125082431ULL);
}

TEST(Random, XoshiroGivesThePublishedSequence) {
  VERIFIES("LASSO-SIM-001~1");
  Random random(std::array<std::uint64_t, 4>{1, 2, 3, 4});
  const std::uint64_t published[] = {11520ULL,
                                     0ULL,
                                     1509978240ULL,
                                     1215971899390074240ULL,
                                     1216172134540287360ULL,
                                     607988272756665600ULL,
                                     16172922978634559625ULL,
                                     8476171486693032832ULL,
                                     10595114339597558777ULL,
                                     2904607092377533576ULL};
  for (const std::uint64_t expected : published) EXPECT_EQ(random.bits(), expected);
}

TEST(Random, LogarithmAgreesWithTheLibrary) {
  VERIFIES("LASSO-SIM-001~1");
  Random random(7);
  for (int i = 0; i < 200000; ++i) {
    const double x = std::ldexp(random.uniform(1, 2), static_cast<int>(random.uniform(-60, 60)));
    const double expected = std::log(x);
    ASSERT_NEAR(natural_logarithm(x), expected, 4e-16 * std::abs(expected) + 2.3e-16) << x;
  }
  EXPECT_EQ(natural_logarithm(1.0), 0.0);
}

TEST(Random, UniformFillsItsInterval) {
  VERIFIES("LASSO-SIM-001~1");
  constexpr int kDraws = 400000;
  constexpr int kBins = 16;
  Random random(11);
  std::array<int, kBins> bins{};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.uniform(-3, 5);
    ASSERT_GE(x, -3);
    ASSERT_LT(x, 5);
    ++bins[static_cast<std::size_t>((x + 3) / 8 * kBins)];
  }
  const double expected = double{kDraws} / kBins;
  for (const int n : bins) EXPECT_NEAR(n, expected, 5 * std::sqrt(expected));
}

// The largest distance between the empirical and the true distribution (Kolmogorov-Smirnov): 1.95 / sqrt(n) is exceeded once in a thousand.
TEST(Random, GaussianFollowsItsDistribution) {
  VERIFIES("LASSO-SIM-001~1");
  constexpr int kDraws = 200000;
  for (const std::uint64_t seed : {1ULL, 2ULL, 99ULL}) {
    Random random(seed);
    std::vector<double> draws(kDraws);
    double sum = 0, sum2 = 0, sum4 = 0;
    for (double& x : draws) {
      x = random.gaussian();
      sum += x;
      sum2 += x * x;
      sum4 += x * x * x * x;
    }
    std::sort(draws.begin(), draws.end());
    double distance = 0;
    for (int i = 0; i < kDraws; ++i) {
      const double truth = 0.5 * std::erfc(-draws[static_cast<std::size_t>(i)] / std::sqrt(2.0));
      distance = std::max({distance, std::abs(truth - double(i) / kDraws), std::abs(truth - double(i + 1) / kDraws)});
    }
    EXPECT_LT(distance, 1.95 / std::sqrt(double{kDraws}));
    EXPECT_NEAR(sum / kDraws, 0, 4 / std::sqrt(double{kDraws}));
    EXPECT_NEAR(sum2 / kDraws, 1, 4 * std::sqrt(2.0 / kDraws));
    EXPECT_NEAR(sum4 / kDraws, 3, 4 * std::sqrt(96.0 / kDraws));
  }
}

// Values of an independent implementation: the bits are the same wherever IEEE 754 holds.
TEST(Random, GaussianHasTheSameBitsEverywhere) {
  VERIFIES("LASSO-SIM-001~1");
  struct Known {
    std::uint64_t seed;
    std::uint32_t scan, ray;
    double draws[4];
  };
  const Known known[] = {
      {1ULL, 0u, 0u, {-0x1.c3b3e7495cbdep-3, 0x1.7af99a775d84dp-1, -0x1.74f064ddd3533p-2, -0x1.21f6b583d5850p+0}},
      {20050101ULL, 359u, 1023u, {-0x1.e1708c7031a1bp-1, 0x1.1b547ad7d2517p-1, -0x1.dfcd424cd4b2bp+0, 0x1.33a7536779a79p-1}},
      {18446744073709551615ULL,
       4294967295u,
       4095u,
       {0x1.2c1d699170c46p-3, 0x1.879aad2e6d351p-2, 0x1.ea3f9408e55f9p-1, -0x1.ded4293d28a5bp+0}},
  };
  for (const Known& k : known) {
    Random random = ray_stream(k.seed, k.scan, k.ray);
    for (const double expected : k.draws) EXPECT_EQ(random.gaussian(), expected);
  }
}

TEST(Random, StreamsDependOnEachOfTheirNumbersAndOnNothingElse) {
  VERIFIES("LASSO-SIM-002~1");
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (std::uint32_t scan = 0; scan < 40; ++scan) {
      for (std::uint32_t ray = 0; ray < 256; ++ray) first.insert(ray_stream(seed, scan, ray).bits());
    }
  }
  EXPECT_EQ(first.size(), 4u * 40u * 256u);
  Random once = ray_stream(5, 6, 7);
  const double x = once.gaussian();
  ray_stream(5, 6, 8).gaussian();
  EXPECT_EQ(ray_stream(5, 6, 7).gaussian(), x);
}

// Neighbouring streams must not resemble each other: correlation of the first draws of rays k and k + 1, scans k and k + 1.
TEST(Random, NeighbouringStreamsAreUncorrelated) {
  VERIFIES("LASSO-SIM-002~1");
  constexpr std::uint32_t kPairs = 100000;
  double of_rays = 0, of_scans = 0;
  for (std::uint32_t k = 0; k < kPairs; ++k) {
    of_rays += ray_stream(3, 1, k).gaussian() * ray_stream(3, 1, k + 1).gaussian();
    of_scans += ray_stream(3, k, 9).gaussian() * ray_stream(3, k + 1, 9).gaussian();
  }
  EXPECT_NEAR(of_rays / kPairs, 0, 4.5 / std::sqrt(double{kPairs}));
  EXPECT_NEAR(of_scans / kPairs, 0, 4.5 / std::sqrt(double{kPairs}));
}

}  // namespace
}  // namespace lasso::sim
