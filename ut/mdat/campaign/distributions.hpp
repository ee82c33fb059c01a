// What samples show of the law that they are drawn from.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace lasso::mdat {

// Largest difference between the sample's distribution function and the law's (Kolmogorov, Smirnov).
template <class Function>
double ks_distance(std::vector<double> sample, const Function& distribution) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double largest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double share = distribution(sample[i]), rank = static_cast<double>(i);
    largest = std::max({largest, share - rank / n, (rank + 1) / n - share});
  }
  return largest;
}

// Below it are 99.9 % of all samples of the law.
inline double ks_limit(double n) { return 1.95 / std::sqrt(n); }

inline double mean_of(const std::vector<double>& sample) {
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

inline double covariance_of(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / static_cast<double>(a.size());
}

inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  return covariance_of(a, b) / std::sqrt(covariance_of(a, a) * covariance_of(b, b));
}

}  // namespace lasso::mdat
