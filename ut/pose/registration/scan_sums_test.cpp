#include "fsw/pose/registration/scan_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// Blocks of 64, four sums side by side within a block: the order that every processor keeps to.
double sum_in_order(const std::vector<float>& products) {
  double total = 0;
  for (std::size_t begin = 0; begin < products.size(); begin += 64) {
    float lane[4] = {};
    for (std::size_t i = begin; i < std::min(begin + 64, products.size()); ++i) lane[(i - begin) % 4] += products[i];
    total += static_cast<double>((lane[0] + lane[1]) + (lane[2] + lane[3]));
  }
  return total;
}

TEST(ScanSums, AddsInTheOrderThatGivesTheSameBitsEverywhere) {
  VERIFIES("LASSO-REG-010~1");
  test::Generator random(7);
  const auto draw = [&random] { return static_cast<float>(random.uniform(0.1, 1)); };
  ScanSums<FloatNumber> sums(1);
  std::vector<float> ranges, normals;
  for (std::size_t i = 0; i < 150; ++i) {
    const float p[3] = {draw(), draw(), draw()}, n[3] = {draw(), draw(), draw()}, weight = draw(), range = draw();
    sums.add(p, n, draw(), weight, range);
    ranges.push_back(range * range);
    normals.push_back(weight * n[1] * n[0]);
  }
  sums.flush();
  Mat6 H;
  Vec6 b;
  sums.unpack(H, b);
  EXPECT_EQ(sums.count(), 150U);
  EXPECT_EQ(sums.squared_range(), sum_in_order(ranges));
  EXPECT_EQ(H(4, 3), sum_in_order(normals));
}

}  // namespace
}  // namespace lasso
