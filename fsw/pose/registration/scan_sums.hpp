// Sums over the points of one pass: weighted normal equations H x = b, x = (rotation, translation) in target axes, and what the residuals
// say.
//
// Row of a point: J = (p x n, n), with n the surface normal and p the point that is held to the surface (of a ray where it meets it, of a
// closest plane the measured one), both in the target frame; residual r, what the point lacks along n. Moving the scan by x brings it J.x
// nearer, so H = sum w J J^T, b = sum w J r: the products of the columns of (J, r), weighted.
#pragma once

#include <cstdint>

#include "fsw/geometry/number.hpp"
#include "fsw/geometry/types.hpp"

namespace lasso {

template <class N>
class ScanSums {
 public:
  // size_m: how far the model reaches from the target's origin, the scale of levers and residuals.
  explicit ScanSums(double size_m) : scale_(N::row_scale(size_m)) {}

  // Adds a row of weight w; range_residual [m] is the same residual along the ray.
  void add(const typename N::Length* p, const typename N::Unit* n, typename N::Length r, typename N::Weight w,
           typename N::Length range_residual) {
    if (rows_ == kBlock) flush();
    const int row = rows_++;
    const bool heavy = scale_.is_heavy(w);
    column_[0][row] = scale_.length(p[1] * n[2] - p[2] * n[1], heavy);
    column_[1][row] = scale_.length(p[2] * n[0] - p[0] * n[2], heavy);
    column_[2][row] = scale_.length(p[0] * n[1] - p[1] * n[0], heavy);
    for (int i = 0; i < 3; ++i) column_[3 + i][row] = scale_.direction(n[i], heavy);
    column_[kResidual][row] = scale_.length(r, heavy);
    weight_[row] = scale_.weight(w);
    range_[row] = scale_.length(range_residual, false);
  }

  // To be called after the last add().
  void flush() {
    count_ += static_cast<std::uint32_t>(rows_);
    for (; rows_ % kLanes != 0; ++rows_) {
      weight_[rows_] = typename N::RowWeight{0};
      range_[rows_] = typename N::Column{0};
    }
    typename N::Weighted weighted[kBlock];
    int k = 0;
    for (int i = 0; i < kColumns; ++i) {
      for (int row = 0; row < rows_; ++row) weighted[row] = weight_[row] * column_[i][row];
      for (int j = 0; j <= i; ++j) total_[k++] += N::sum(product(weighted, column_[j]));
    }
    squared_range_ += N::sum(product(range_, range_));
    rows_ = 0;
  }

  // H (both triangles) and b.
  void unpack(Mat6& H, Vec6& b) const {
    int k = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j, ++k) {
        H(i, j) = static_cast<double>(total_[k]) * scale_of(i) * scale_of(j);
        H(j, i) = H(i, j);
      }
    }
    for (int i = 0; i < 6; ++i) b[i] = static_cast<double>(total_[k + i]) * scale_of(i) * scale_of(kResidual);
  }
  std::uint32_t count() const { return count_; }
  double chi_squared() const { return static_cast<double>(total_[kSums - 1]) * scale_of(kResidual) * scale_of(kResidual); }  // sum w r^2
  double squared_range() const {
    return static_cast<double>(squared_range_) * scale_of(kResidual) * scale_of(kResidual);
  }  // m^2, unweighted

 private:
  // Rows are summed in blocks in the path's type, block by block in N::Sum: as fast as the one, as exact as the other. Within a block four
  // sums run side by side, in an order that is written here: a processor with lanes uses them, one without gives the same bits.
  static constexpr int kBlock = 64;
  static constexpr int kLanes = 4;
  static constexpr int kColumns = 7;  // J, r
  static constexpr int kResidual = 6;
  static constexpr int kSums = 28;  // lower triangle of the columns' products by rows: H, then b, then chi^2
  using Column = typename N::Column[kBlock];

  template <class A, class B>
  auto product(const A& a, const B& b) const {
    decltype(a[0] * b[0]) lane[kLanes] = {};
    for (int row = 0; row < rows_; row += kLanes) {
      for (int l = 0; l < kLanes; ++l) lane[l] += a[row + l] * b[row + l];
    }
    return (lane[0] + lane[1]) + (lane[2] + lane[3]);
  }

  // In metres, or of no unit, of a column's 1.
  double scale_of(int column) const { return column < 3 || column == kResidual ? scale_.of_one() : 1; }

  typename N::RowScale scale_;
  Column column_[kColumns] = {};
  typename N::RowWeight weight_[kBlock] = {};
  Column range_ = {};
  typename N::Sum total_[kSums] = {};
  typename N::Sum squared_range_{};
  int rows_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace lasso
