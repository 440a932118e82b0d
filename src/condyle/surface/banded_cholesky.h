#pragma once

/// Symmetric positive definite systems whose entries lie near the diagonal: the normal equations of
/// a tensor-product fit.

#include <Eigen/Core>

#include <vector>

namespace condyle {

/// Lower half of a symmetric n x n matrix with `band` diagonals below the main one.
class BandedMatrix {
 public:
  BandedMatrix() = default;
  BandedMatrix(int n, int band)
      : n_(n), band_(band), entries_(static_cast<std::size_t>(n) * (band + 1), 0.0) {}

  [[nodiscard]] int size() const { return n_; }
  [[nodiscard]] int band() const { return band_; }
  /// Entry (i, j), i - band <= j <= i.
  [[nodiscard]] double& at(int i, int j) { return entries_[index(i, j)]; }
  [[nodiscard]] double at(int i, int j) const { return entries_[index(i, j)]; }
  /// This plus `factor` times a matrix of the same shape.
  [[nodiscard]] BandedMatrix plus(double factor, const BandedMatrix& other) const;

  /// Replaces the matrix by its Cholesky factor; false where it is not positive definite.
  [[nodiscard]] bool factorize();
  /// This times a vector.
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& x) const;

  /// Solves in place with the factor; columns are right-hand sides.
  void solve(Eigen::MatrixXd& b) const;

 private:
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) * (band_ + 1) + static_cast<std::size_t>(j - i + band_);
  }
  int n_ = 0, band_ = 0;
  std::vector<double> entries_;  ///< row by row
};

/// Greatest over least eigenvalue of a positive definite matrix, by power iteration; good to a few
/// per cent. `factor` is its Cholesky factor.
[[nodiscard]] double condition_number(const BandedMatrix& matrix, const BandedMatrix& factor);

}  // namespace condyle
