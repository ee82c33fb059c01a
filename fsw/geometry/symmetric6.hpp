// Symmetric 6x6 systems: factorisation that is checked, inverse, eigen-decomposition in bounded sweeps.
#pragma once

#include "fsw/core/status.hpp"
#include "fsw/geometry/types.hpp"

namespace lasso {

// Solves A x = b by LDL^T, A symmetric positive definite. kSingular when a pivot is not above 1e-12 of A's largest diagonal,
// kNotFinite when A or b is not finite; x is then untouched. Reads A's lower triangle. Loop bound 6^3.
Status solve6(const Mat6& A, const Vec6& b, Vec6& x);

// A's inverse by the same factorisation and with the same answers; exactly symmetric.
Status invert6(const Mat6& A, Mat6& inverse);

struct Eigen6 {
  Vec6 values;   // ascending
  Mat6 vectors;  // columns, unit length, in the order of the values
};
// Cyclic Jacobi, at most 12 sweeps of 15 rotations. Relative accuracy also of the small eigenvalues of a positive definite matrix that is
// badly scaled (rad beside m). What is not finite gives NaN. The sign of a vector is as the rotations leave it.
Eigen6 eigen6(const Mat6& A);

// The covariance of (rotation * radius, translation) from that of (rotation, translation); with 1 / radius the other way.
Mat6 at_radius(const Mat6& covariance, double radius);

// Its axes: directions over (rotation * radius, translation), and their variances.
Eigen6 axes_at_radius(const Mat6& covariance, double radius);

// The covariance of (rotation, translation) in the axes that R leads to from its own: J C J^T with R twice in J's diagonal.
Mat6 rotated_covariance(const Mat3& R, const Mat6& covariance);

}  // namespace lasso
