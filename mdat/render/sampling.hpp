// Sample positions that depend on the pixel, the sample and what it is for alone: no thread can change them.
#pragma once

#include <cstdint>

#include "hal_sim/random.hpp"

namespace lasso::mdat {

struct UnitSquare {
  double u = 0.5, v = 0.5;  // [0, 1)
};

// The samples of one pixel: n x n cells of a unit square, of which each sample has one, at a random place of it.
class PixelSamples {
 public:
  PixelSamples(std::uint64_t pixel, int per_axis) : pixel_(pixel), per_axis_(per_axis) {}

  int count() const { return per_axis_ * per_axis_; }
  // Of a sample (< count) for one purpose; over the samples every cell is taken once, in an order that differs from pixel to pixel.
  UnitSquare at(int sample, std::uint32_t purpose) const {
    std::uint64_t state = (pixel_ << 8) ^ (std::uint64_t{purpose} << 56);
    const std::uint64_t turn = sim::split_mix64(state);
    const auto cell = static_cast<int>((static_cast<std::uint64_t>(sample) + turn) % static_cast<std::uint64_t>(count()));
    state += static_cast<std::uint64_t>(sample) << 32;
    const std::uint64_t bits = sim::split_mix64(state);
    const int column = cell % per_axis_, row = cell / per_axis_;
    return {(column + kUnit * static_cast<double>(bits >> 32)) / per_axis_,
            (row + kUnit * static_cast<double>(bits & 0xFFFFFFFFU)) / per_axis_};
  }

 private:
  static constexpr double kUnit = 1.0 / 4294967296.0;
  std::uint64_t pixel_;
  int per_axis_;
};

}  // namespace lasso::mdat
