// Eigen's decompositions as the truth of tests, for matrices of any size and compiled once: a fixed size takes each test file seconds.
#pragma once

#include <Eigen/Core>

namespace lasso::test {

using Dense = Eigen::MatrixXd;
using DenseVector = Eigen::VectorXd;

Dense inverse_of(const Dense& A);                               // A symmetric
DenseVector solution_of(const Dense& A, const DenseVector& b);  // A symmetric
Dense cholesky_of(const Dense& A);                              // the lower factor; A positive definite
DenseVector eigenvalues_of(const Dense& A);                     // ascending; A symmetric
Dense orthogonal_of(const Dense& A);                            // of the unit eigenvectors of A's symmetric part

// In extended precision, where the target has any (not in PowerPC's pairs of doubles). A symmetric.
DenseVector wide_solution_of(const Dense& A, const DenseVector& b);
DenseVector wide_eigenvalues_of(const Dense& A);
Dense wide_inverse_of(const Dense& A);
double wide_least_eigenvalue_of(const Dense& A);  // as the largest of the inverse, which is accurate; A positive definite

}  // namespace lasso::test
