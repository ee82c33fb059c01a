#include "fsw/geometry/symmetric6.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

constexpr int kSize = 6;
constexpr double kPivotMin = 1e-12;  // of the largest diagonal element
constexpr int kSweepsMax = 12;
// An off-diagonal element below 2^-53 of the geometric mean of its diagonal elements changes no eigenvalue.
constexpr double kNegligible2 = 0x1p-106;

template <class M>
bool all_finite(const M& m) {
  bool finite = true;
  for (int i = 0; i < m.size(); ++i) finite = finite && is_finite(m.data()[i]);
  return finite;
}

double absolute(double x) { return x < 0 ? -x : x; }

double largest_diagonal(const Mat6& A) {
  double largest = 0;
  for (int i = 0; i < kSize; ++i) {
    if (A(i, i) > largest) largest = A(i, i);
  }
  return largest;
}

struct Factors {
  Mat6 L;  // unit lower triangular; only the part below the diagonal is set
  Vec6 d;
};

// A = L D L^T from A's lower triangle (Golub, Van Loan, Matrix Computations, 4.1.2).
Status factorise(const Mat6& A, Factors& f) {
  if (!all_finite(A)) return Status::kNotFinite;
  const double limit = kPivotMin * largest_diagonal(A);
  for (int j = 0; j < kSize; ++j) {
    double pivot = A(j, j);
    for (int k = 0; k < j; ++k) pivot -= f.L(j, k) * f.L(j, k) * f.d[k];
    if (!(pivot > limit)) return Status::kSingular;
    f.d[j] = pivot;
    for (int i = j + 1; i < kSize; ++i) {
      double sum = A(i, j);
      for (int k = 0; k < j; ++k) sum -= f.L(i, k) * f.L(j, k) * f.d[k];
      f.L(i, j) = sum / pivot;
    }
  }
  return Status::kOk;
}

// The columns of L^-1 by forward substitution; below the diagonal only.
void invert_unit_lower(const Mat6& L, Mat6& W) {
  W = Mat6::Identity();
  for (int j = 0; j < kSize; ++j) {
    for (int i = j + 1; i < kSize; ++i) {
      double sum = 0;
      for (int k = j; k < i; ++k) sum -= L(i, k) * W(k, j);
      W(i, j) = sum;
    }
  }
}

struct Rotation {
  double cosine;
  double sine;
};

// The smaller rotation that makes A(p, q) zero (Golub, Van Loan, 8.5.2).
Rotation annihilating(const Mat6& A, int p, int q) {
  const double theta = (A(q, q) - A(p, p)) / (2.0 * A(p, q));
  const double t = (theta < 0 ? -1.0 : 1.0) / (absolute(theta) + square_root(theta * theta + 1.0));
  const double cosine = 1.0 / square_root(t * t + 1.0);
  return {cosine, t * cosine};
}

void rotate_columns(Mat6& M, int p, int q, const Rotation& r) {
  for (int i = 0; i < kSize; ++i) {
    const double a = M(i, p);
    const double b = M(i, q);
    M(i, p) = r.cosine * a - r.sine * b;
    M(i, q) = r.sine * a + r.cosine * b;
  }
}

void rotate_rows(Mat6& M, int p, int q, const Rotation& r) {
  for (int i = 0; i < kSize; ++i) {
    const double a = M(p, i);
    const double b = M(q, i);
    M(p, i) = r.cosine * a - r.sine * b;
    M(q, i) = r.sine * a + r.cosine * b;
  }
}

// True when it had something to do. The diagonal is updated by t * A(p, q), which keeps small eigenvalues accurate.
bool annihilate(Mat6& A, Mat6& vectors, int p, int q) {
  const double off = A(p, q);
  if (off == 0 || off * off <= kNegligible2 * absolute(A(p, p) * A(q, q))) return false;
  const Rotation r = annihilating(A, p, q);
  const double shift = r.sine / r.cosine * off;
  const double at_p = A(p, p) - shift;
  const double at_q = A(q, q) + shift;
  rotate_columns(A, p, q, r);
  rotate_rows(A, p, q, r);
  A(p, p) = at_p;
  A(q, q) = at_q;
  A(p, q) = 0;
  A(q, p) = 0;
  rotate_columns(vectors, p, q, r);
  return true;
}

bool sweep(Mat6& A, Mat6& vectors) {
  bool changed = false;
  for (int p = 0; p < kSize - 1; ++p) {
    for (int q = p + 1; q < kSize; ++q) {
      const bool rotated = annihilate(A, vectors, p, q);
      changed = changed || rotated;
    }
  }
  return changed;
}

void sort_ascending(Eigen6& e) {
  for (int i = 0; i < kSize - 1; ++i) {
    int least = i;
    for (int j = i + 1; j < kSize; ++j) {
      if (e.values[j] < e.values[least]) least = j;
    }
    const double value = e.values[i];
    const Vec6 vector = e.vectors.col(i);
    e.values[i] = e.values[least];
    e.vectors.col(i) = e.vectors.col(least);
    e.values[least] = value;
    e.vectors.col(least) = vector;
  }
}

}  // namespace

Status solve6(const Mat6& A, const Vec6& b, Vec6& x) {
  Factors f;
  const Status status = factorise(A, f);
  if (status == Status::kNotFinite || !all_finite(b)) return Status::kNotFinite;
  if (status != Status::kOk) return status;
  Vec6 y = b;
  for (int i = 0; i < kSize; ++i) {
    for (int k = 0; k < i; ++k) y[i] -= f.L(i, k) * y[k];
  }
  for (int i = 0; i < kSize; ++i) y[i] /= f.d[i];
  for (int i = kSize - 2; i >= 0; --i) {
    for (int k = i + 1; k < kSize; ++k) y[i] -= f.L(k, i) * y[k];
  }
  if (!all_finite(y)) return Status::kSingular;  // overflow on the way
  x = y;
  return Status::kOk;
}

// A^-1 = W^T D^-1 W with W = L^-1: exactly symmetric.
Status invert6(const Mat6& A, Mat6& inverse) {
  Factors f;
  const Status status = factorise(A, f);
  if (status != Status::kOk) return status;
  Mat6 W;
  invert_unit_lower(f.L, W);
  Mat6 result;
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0;
      for (int k = i; k < kSize; ++k) sum += W(k, i) * W(k, j) / f.d[k];
      result(i, j) = sum;
      result(j, i) = sum;
    }
  }
  if (!all_finite(result)) return Status::kSingular;
  inverse = result;
  return Status::kOk;
}

Eigen6 eigen6(const Mat6& A) {
  Mat6 work = A;
  Eigen6 e;
  e.vectors = Mat6::Identity();
  bool changed = true;
  for (int i = 0; i < kSweepsMax && changed; ++i) changed = sweep(work, e.vectors);
  e.values = work.diagonal();
  sort_ascending(e);
  return e;
}

Mat6 at_radius(const Mat6& covariance, double radius) {
  Mat6 result = covariance;
  for (int i = 0; i < 3; ++i) result.row(i) *= radius;
  for (int i = 0; i < 3; ++i) result.col(i) *= radius;
  return result;
}

Eigen6 axes_at_radius(const Mat6& covariance, double radius) { return eigen6(at_radius(covariance, radius)); }

Mat6 rotated_covariance(const Mat3& R, const Mat6& covariance) {
  Mat6 result;
  for (int i = 0; i < kSize; i += 3) {  // in a loop: unrolled it is four kilobytes of a flight image
    for (int j = 0; j < kSize; j += 3) result.block<3, 3>(i, j) = R * covariance.block<3, 3>(i, j) * R.transpose();
  }
  return result;
}

}  // namespace lasso
