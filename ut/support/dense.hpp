// Eigen's decompositions as the truth of tests, for matrices of any size and compiled once: a fixed size takes each test file seconds.
#pragma once

#include <Eigen/Core>

namespace lasso::test {

using Dense = Eigen::MatrixXd;
using DenseVector = Eigen::VectorXd;

// In extended precision, but eigenvalues on PowerPC in double: they do not converge in its pairs of doubles.
Dense inverse_of(const Dense& A);                               // A symmetric
Dense congruence(const Dense& A, const Dense& B);               // A B A^T; A may have any shape
DenseVector solution_of(const Dense& A, const DenseVector& b);  // A symmetric
Dense cholesky_of(const Dense& A);                              // the lower factor; A positive definite
DenseVector eigenvalues_of(const Dense& A);                     // ascending; A symmetric
Dense orthogonal_of(const Dense& A);                            // of the unit eigenvectors of A's symmetric part
double least_eigenvalue_of(const Dense& A);                     // as the largest of the inverse, which is accurate; A positive definite

}  // namespace lasso::test
