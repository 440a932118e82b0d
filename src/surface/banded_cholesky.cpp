#include "surface/banded_cholesky.h"

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

}  // namespace condyle
