#include "condyle/surface/banded_cholesky.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace condyle {
namespace {
using ConstRow = Eigen::Map<const Eigen::VectorXd>;
}

BandedMatrix BandedMatrix::plus(double factor, const BandedMatrix& other) const {
  assert(n_ == other.n_ && band_ == other.band_);
  BandedMatrix sum = *this;
  for (std::size_t k = 0; k < entries_.size(); ++k) sum.entries_[k] += factor * other.entries_[k];
  return sum;
}

bool BandedMatrix::factorize() {
  // A = L Lᵀ row by row: L_ij = (A_ij - Σ_k L_ik L_jk) / L_jj over the columns both rows hold.
  for (int i = 0; i < n_; ++i) {
    const int first_i = std::max(0, i - band_);
    for (int j = first_i; j <= i; ++j) {
      const int first = std::max(first_i, j - band_);
      const ConstRow row_i(entries_.data() + index(i, first), j - first);
      const ConstRow row_j(entries_.data() + index(j, first), j - first);
      const double rest = at(i, j) - row_i.dot(row_j);
      if (j < i) {
        at(i, j) = rest / at(j, j);
      } else {
        if (!(rest > 0)) return false;
        at(i, i) = std::sqrt(rest);
      }
    }
  }
  return true;
}

void BandedMatrix::solve(Eigen::MatrixXd& b) const {
  assert(b.rows() == n_);
  for (int i = 0; i < n_; ++i) {
    const int first = std::max(0, i - band_);
    const ConstRow row(entries_.data() + index(i, first), i - first);
    b.row(i) -= row.transpose() * b.middleRows(first, i - first);
    b.row(i) /= at(i, i);
  }
  for (int i = n_ - 1; i >= 0; --i) {
    const int first = std::max(0, i - band_);
    const ConstRow row(entries_.data() + index(i, first), i - first);
    b.row(i) /= at(i, i);
    b.middleRows(first, i - first).noalias() -= row * b.row(i);
  }
}

Eigen::VectorXd BandedMatrix::times(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n_);
  for (int i = 0; i < n_; ++i) {
    y[i] += at(i, i) * x[i];
    for (int j = std::max(0, i - band_); j < i; ++j) {
      y[i] += at(i, j) * x[j];
      y[j] += at(i, j) * x[i];
    }
  }
  return y;
}

double condition_number(const BandedMatrix& matrix, const BandedMatrix& factor) {
  constexpr int kRounds = 25;
  Eigen::VectorXd large(matrix.size());
  for (int i = 0; i < matrix.size(); ++i) large[i] = 1 + 0.5 * std::sin(12.9898 * (i + 1));
  Eigen::MatrixXd small = large;
  double greatest = 0, inverse_least = 0;
  for (int round = 0; round < kRounds; ++round) {
    large = matrix.times(large.normalized().eval());
    greatest = large.norm();
    small = small.normalized().eval();
    factor.solve(small);
    inverse_least = small.norm();
  }
  return greatest * inverse_least;
}

}  // namespace condyle
