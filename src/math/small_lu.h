#pragma once

/// LU factorisation with partial pivoting of a small dense system, in place and without allocation:
/// the Newton matrices of this program have at most 6 + 6 rows.

#include <array>

namespace condyle {

class SmallLu {
 public:
  static constexpr int kMaxSize = 12;

  /// Entries of the matrix, to be filled by the caller: row i, column j.
  double& operator()(int i, int j) { return a_[i][j]; }
  double operator()(int i, int j) const { return a_[i][j]; }

  /// Sets the leading n x n block to zero.
  void clear(int n);

  /// Factors the leading n x n block. False where a pivot vanishes relative to its row's largest
  /// entry.
  bool factor(int n);

  /// Solves A x = b for b and x of length n; `b` becomes x.
  void solve(double* b) const;

  /// Smallest over largest pivot of the last factorisation: a cheap hint at the condition.
  [[nodiscard]] double pivot_ratio() const { return pivot_ratio_; }

 private:
  double a_[kMaxSize][kMaxSize];
  std::array<int, kMaxSize> row_{};
  int n_ = 0;
  double pivot_ratio_ = 0;
};

}  // namespace condyle
