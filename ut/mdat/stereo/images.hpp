// Grey images and their statistics.
#pragma once

#include <cmath>

#include "mdat/stereo/imager.hpp"

namespace lasso::mdat {

inline GreyImage even(int width, int height, double value) {
  return {width, height, std::vector<double>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value)};
}

struct Spread {
  double mean = 0, sigma = 0;
};

template <class Values>
Spread spread_of(const Values& values) {
  double sum = 0, squares = 0;
  for (const auto value : values) sum += static_cast<double>(value);
  const double mean = sum / static_cast<double>(values.size());
  for (const auto value : values) squares += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size() - 1))};
}

}  // namespace lasso::mdat
