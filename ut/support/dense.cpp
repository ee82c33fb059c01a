#include "ut/support/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <type_traits>

namespace lasso::test {
namespace {

using Real = long double;  // for all: each type takes the compiler seconds
using Wide = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
// This solver does not converge in PowerPC's pairs of doubles.
using SolverReal = std::conditional_t<std::numeric_limits<Real>::is_iec559, Real, double>;
using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<SolverReal, Eigen::Dynamic, Eigen::Dynamic>>;

Wide wide_inverse(const Wide& A) { return A.ldlt().solve(Wide::Identity(A.rows(), A.cols())); }

}  // namespace

Dense inverse_of(const Dense& A) { return wide_inverse(A.cast<Real>()).cast<double>(); }

Dense congruence(const Dense& A, const Dense& B) { return A * B * A.transpose(); }

DenseVector solution_of(const Dense& A, const DenseVector& b) {
  const Wide x = A.cast<Real>().ldlt().solve(Wide(b.cast<Real>()));
  return x.cast<double>();
}

Dense cholesky_of(const Dense& A) { return Wide(A.cast<Real>().llt().matrixL()).cast<double>(); }

DenseVector eigenvalues_of(const Dense& A) { return Solver(A.cast<SolverReal>()).eigenvalues().cast<double>(); }

Dense orthogonal_of(const Dense& A) { return Solver((A + A.transpose()).cast<SolverReal>()).eigenvectors().cast<double>(); }

double least_eigenvalue_of(const Dense& A) {
  const Wide inverse = wide_inverse(A.cast<Real>());
  const Solver solver((Real(0.5) * (inverse + inverse.transpose())).cast<SolverReal>());
  return static_cast<double>(SolverReal(1) / solver.eigenvalues()[A.rows() - 1]);
}

}  // namespace lasso::test
