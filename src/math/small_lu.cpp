#include "math/small_lu.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace condyle {

void SmallLu::clear(int n) {
  assert(n <= kMaxSize);
  for (int i = 0; i < n; ++i) std::fill(a_[i], a_[i] + n, 0.0);
}

bool SmallLu::factor(int n) {
  n_ = n;
  double largest = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) largest = std::max(largest, std::abs(a_[i][j]));
  double greatest = 0, least = largest;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a_[i][k]) > std::abs(a_[pivot][k])) pivot = i;
    row_[k] = pivot;
    if (pivot != k) std::swap_ranges(a_[k], a_[k] + n, a_[pivot]);
    const double p = std::abs(a_[k][k]);
    greatest = std::max(greatest, p);
    least = std::min(least, p);
    if (!(p > 1e-15 * largest)) {
      pivot_ratio_ = 0;
      return false;
    }
    const double inverse = 1 / a_[k][k];
    for (int i = k + 1; i < n; ++i) {
      const double factor = a_[i][k] * inverse;
      a_[i][k] = factor;
      if (factor == 0) continue;
      for (int j = k + 1; j < n; ++j) a_[i][j] -= factor * a_[k][j];
    }
  }
  pivot_ratio_ = n == 0 ? 1 : least / greatest;
  return true;
}

void SmallLu::solve(double* b) const {
  for (int k = 0; k < n_; ++k) std::swap(b[k], b[row_[k]]);
  for (int i = 1; i < n_; ++i)
    for (int k = 0; k < i; ++k) b[i] -= a_[i][k] * b[k];
  for (int i = n_ - 1; i >= 0; --i) {
    for (int k = i + 1; k < n_; ++k) b[i] -= a_[i][k] * b[k];
    b[i] /= a_[i][i];
  }
}

}  // namespace condyle
