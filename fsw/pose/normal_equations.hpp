// Weighted normal equations H x = b of one pass over the points, x = (rotation, translation) in target axes.
//
// Row of a point: J = (m x n, n), with m the measured point and n the surface normal, both in the target frame; residual r = n.(q - m), q
// the surface point on the ray. Moving the scan by x changes n.m by J.x, so H = sum w J J^T, b = sum w J r.
#pragma once

#include <cstdint>

#include "fsw/geometry/types.hpp"

namespace lasso {

template <class N>
struct NormalEquations {
  // Lower triangle by rows: (0,0) (1,0) (1,1) (2,0) ...; then the right-hand side. Sums run in blocks of kBlock points in the path's type
  // and go to N::Sum block by block: fast, and as exact as the long sum would be.
  static constexpr int kBlock = 32;
  typename N::Ratio block[27] = {};
  typename N::Sum total[27] = {};
  int in_block = 0;
  std::uint32_t count = 0;

  void add(const typename N::Length* m, const typename N::Unit* n, typename N::Length r, typename N::Ratio w) {
    const typename N::Ratio J[6] = {m[1] * n[2] - m[2] * n[1], m[2] * n[0] - m[0] * n[2], m[0] * n[1] - m[1] * n[0], n[0], n[1], n[2]};
    typename N::Ratio wJ[6];
    for (int i = 0; i < 6; ++i) wJ[i] = w * J[i];
    int k = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) block[k++] += wJ[i] * J[j];
    }
    for (int i = 0; i < 6; ++i) block[k++] += wJ[i] * r;
    ++count;
    if (++in_block == kBlock) flush();
  }

  void flush() {
    for (int k = 0; k < 27; ++k) {
      total[k] += static_cast<typename N::Sum>(block[k]);
      block[k] = 0;
    }
    in_block = 0;
  }

  // Adds `scale` times the sums to H and b (both triangles of H). Call after flush().
  void unpack(Mat6& H, Vec6& b) const {
    int k = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j, ++k) {
        H(i, j) = static_cast<double>(total[k]);
        H(j, i) = H(i, j);
      }
    }
    for (int i = 0; i < 6; ++i) b[i] = static_cast<double>(total[k++]);
  }
};

}  // namespace lasso
