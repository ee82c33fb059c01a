#include "ut/support/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace lasso::test {
namespace {

using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

Wide wide_inverse(const Dense& A) { return A.cast<long double>().ldlt().solve(Wide::Identity(A.rows(), A.cols())); }

}  // namespace

Dense inverse_of(const Dense& A) { return A.ldlt().solve(Dense::Identity(A.rows(), A.cols())); }

DenseVector solution_of(const Dense& A, const DenseVector& b) { return A.ldlt().solve(b); }

Dense cholesky_of(const Dense& A) { return A.llt().matrixL(); }

DenseVector eigenvalues_of(const Dense& A) { return Eigen::SelfAdjointEigenSolver<Dense>(A).eigenvalues(); }

Dense orthogonal_of(const Dense& A) { return Eigen::SelfAdjointEigenSolver<Dense>(A + A.transpose()).eigenvectors(); }

DenseVector wide_solution_of(const Dense& A, const DenseVector& b) {
  return A.cast<long double>().ldlt().solve(b.cast<long double>()).cast<double>();
}

DenseVector wide_eigenvalues_of(const Dense& A) {
  return Eigen::SelfAdjointEigenSolver<Wide>(A.cast<long double>()).eigenvalues().cast<double>();
}

Dense wide_inverse_of(const Dense& A) { return wide_inverse(A).cast<double>(); }

double wide_least_eigenvalue_of(const Dense& A) {
  const Wide inverse = wide_inverse(A);
  const Eigen::SelfAdjointEigenSolver<Wide> solver(0.5L * (inverse + inverse.transpose()));
  return static_cast<double>(1.0L / solver.eigenvalues()[A.rows() - 1]);
}

}  // namespace lasso::test
