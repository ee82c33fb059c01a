// Sums over the points of one pass: weighted normal equations H x = b, x = (rotation, translation) in target axes, and what the residuals
// say.
//
// Row of a point: J = (m x n, n), with m the measured point and n the surface normal, both in the target frame; residual r = n.(q - m), q
// the surface point on the ray. Moving the scan by x changes n.m by J.x, so H = sum w J J^T, b = sum w J r.
#pragma once

#include <cstdint>

#include "fsw/geometry/types.hpp"

namespace lasso {

template <class N>
class ScanSums {
 public:
  // Adds a row of weight w; range_residual [m] is the same residual along the ray.
  void add(const typename N::Length* m, const typename N::Unit* n, typename N::Length r, typename N::Ratio w,
           typename N::Length range_residual) {
    const typename N::Ratio J[6] = {m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2], m[0] * n[1] - m[1] * n[0], n[0], n[1], n[2]};
    int k = 0;
    for (int i = 0; i < 6; ++i) {
      const typename N::Ratio wJ = w * J[i];
      for (int j = 0; j <= i; ++j) block_[k++] += wJ * J[j];
      block_[kRightSide + i] += wJ * r;
    }
    block_[kChiSquared] += w * r * r;
    block_[kSquaredRange] += range_residual * range_residual;
    ++count_;
    if (++in_block_ == kBlock) flush();
  }

  // To be called after the last add().
  void flush() {
    for (int k = 0; k < kSums; ++k) {
      total_[k] += static_cast<typename N::Sum>(block_[k]);
      block_[k] = 0;
    }
    in_block_ = 0;
  }

  // H (both triangles) and b.
  void unpack(Mat6& H, Vec6& b) const {
    int k = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j, ++k) {
        H(i, j) = static_cast<double>(total_[k]);
        H(j, i) = H(i, j);
      }
      b[i] = static_cast<double>(total_[kRightSide + i]);
    }
  }
  std::uint32_t count() const { return count_; }
  double chi_squared() const { return static_cast<double>(total_[kChiSquared]); }      // sum w r^2
  double squared_range() const { return static_cast<double>(total_[kSquaredRange]); }  // m^2, unweighted

 private:
  // Lower triangle of H by rows: (0,0) (1,0) (1,1) (2,0) ...; then b; then the residuals. Sums run in blocks in the path's type and go to
  // N::Sum block by block: as fast as the one, as exact as the other.
  static constexpr int kBlock = 32;
  static constexpr int kRightSide = 21;
  static constexpr int kChiSquared = 27;
  static constexpr int kSquaredRange = 28;
  static constexpr int kSums = 29;

  typename N::Ratio block_[kSums] = {};
  typename N::Sum total_[kSums] = {};
  int in_block_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace lasso
