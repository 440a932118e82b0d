#include "condyle/math/small_lu.h"

#include <algorithm>
#include <cmath>

#include "condyle/math/simd.h"

namespace condyle {

CONDYLE_FMA_CLONE
bool SmallLu::factor(int n) {
  n_ = n;
  double largest = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) largest = std::max(largest, std::abs(a_[i][j]));
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a_[i][k]) > std::abs(a_[pivot][k])) pivot = i;
    row_[k] = pivot;
    if (pivot != k) {
      for (int j = 0; j < kStride; j += 4) {
        const Four upper = load_four(a_[k] + j), lower = load_four(a_[pivot] + j);
        store_four(a_[k] + j, lower);
        store_four(a_[pivot] + j, upper);
      }
      for (int j = 0; j < k; ++j) std::swap(multipliers_[j][k], multipliers_[j][pivot]);
    }
    const double p = std::abs(a_[k][k]);
    if (!(p > 1e-15 * largest)) return false;
    const double inverse = 1 / a_[k][k];
    inverse_pivot_[k] = inverse;
    const int first = (k + 1) / 4 * 4;
    for (int i = k + 1; i < n; ++i) {
      const double factor = a_[i][k] * inverse;
      multipliers_[k][i] = factor;
      for (int j = first; j < n; j += 4)
        store_four(a_[i] + j, load_four(a_[i] + j) - factor * load_four(a_[k] + j));
    }
  }
  return true;
}

CONDYLE_FMA_CLONE
void SmallLu::solve(double* b) const {
  alignas(32) double x[kStride] = {};
  std::copy(b, b + n_, x);
  for (int k = 0; k < n_; ++k) std::swap(x[k], x[row_[k]]);
  for (int k = 0; k < n_; ++k)
    for (int i = k + 1; i < n_; ++i) x[i] -= multipliers_[k][i] * x[k];
  for (int i = n_ - 1; i >= 0; --i) {
    double sum = x[i];
    for (int k = i + 1; k < n_; ++k) sum -= a_[i][k] * x[k];
    x[i] = sum * inverse_pivot_[i];
  }
  std::copy(x, x + n_, b);
}

// With P A = L U: Uᵀ y = b, Lᵀ z = y, x = Pᵀ z.
void SmallLu::solve_transposed(double* b) const {
  std::array<double, kMaxSize> x{};
  std::copy(b, b + n_, x.begin());
  for (int i = 0; i < n_; ++i) {
    x[i] *= inverse_pivot_[i];
    for (int k = i + 1; k < n_; ++k) x[k] -= a_[i][k] * x[i];
  }
  for (int k = n_ - 1; k >= 0; --k)
    for (int i = k + 1; i < n_; ++i) x[k] -= multipliers_[k][i] * x[i];
  for (int k = n_ - 1; k >= 0; --k) std::swap(x[k], x[row_[k]]);
  std::copy(x.begin(), x.begin() + n_, b);
}

}  // namespace condyle
