// Poses and covariances as packets hold them. Inside of fsw/exec.
#pragma once

#include "fsw/core/span.hpp"
#include "fsw/geometry/se3.hpp"

namespace lasso {

// Quaternion x, y, z, w.
inline void copy_pose(const Pose& pose, double (&q)[4], double (&p)[3]) {
  const double coefficients[4] = {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()};
  for (int i = 0; i < 4; ++i) q[i] = coefficients[i];
  for (int i = 0; i < 3; ++i) p[i] = pose.p[i];
}

// By rows. Loop bound: the terms.
template <class Matrix, class Term>
void copy_upper_triangle(const Matrix& covariance, Span<Term> terms) {
  std::size_t term = 0;
  for (int row = 0; row < covariance.rows(); ++row) {
    for (int column = row; column < covariance.cols(); ++column) {
      terms[term] = static_cast<Term>(covariance(row, column));
      ++term;
    }
  }
}

}  // namespace lasso
