#pragma once

/// LU factorisation with partial pivoting of a small dense system, in place and without allocation:
/// the Newton matrices of this program have at most 6 + 6 rows, and one more along a path
/// (arc_length.h).

#include <array>

namespace condyle {

class SmallLu {
 public:
  static constexpr int kMaxSize = 13;

  /// Entries of the matrix, to be filled by the caller: row i, column j.
  double& operator()(int i, int j) { return a_[i][j]; }
  double operator()(int i, int j) const { return a_[i][j]; }

  /// Factors the leading n x n block. False where a pivot vanishes relative to the largest entry.
  bool factor(int n);

  /// Solves A x = b for b and x of length n; `b` becomes x.
  void solve(double* b) const;

  /// Solves Aᵀ x = b likewise.
  void solve_transposed(double* b) const;

 private:
  static constexpr int kStride = 16;  ///< rows are worked on four numbers at a time
  // After factor(): U in the upper triangle of a_ (below it nothing that means anything), the
  // multipliers of pivot k in row k of multipliers_.
  alignas(32) double a_[kMaxSize][kStride] = {};
  alignas(32) double multipliers_[kMaxSize][kStride] = {};
  std::array<double, kMaxSize> inverse_pivot_{};
  std::array<int, kMaxSize> row_{};
  int n_ = 0;
};

}  // namespace condyle
