#pragma once

/// A bicubic patch as a polynomial in each of its knot cells, c(u, v) = Σ a_kl x^k y^l with x and y
/// from the corner of the cell: for many evaluations, four at once. Sixteen coefficients a cell in
/// place of two rows of basis functions, which is a quarter of the arithmetic and eight times the
/// memory.

#include <array>
#include <vector>

#include "condyle/surface/patch.h"

namespace condyle {

/// c, c_u, c_v, c_uu, c_uv, c_vv of four places: [derivative][coordinate][place].
struct alignas(32) FourDerivatives {
  double d[6][3][4];
};

class PatchCells {
 public:
  /// The patch is referred to. One of other degrees, and places beyond the box of parameters, are
  /// left to the patch itself.
  explicit PatchCells(const Patch& patch);

  /// At four places (u, v), by value as Patch::derivatives to round-off.
  void derivatives(const double* u, const double* v, FourDerivatives& out) const;

  struct alignas(32) Cell {
    double a[4][4][4];  ///< [power of u][power of v][coordinate, the last idle]
  };
  [[nodiscard]] int orientation() const { return patch_.data().orientation; }
  /// How many there are along u and v; 0 where the patch is not bicubic.
  [[nodiscard]] std::array<int, 2> counts() const {
    if (cells_.empty()) return {0, 0};
    return {static_cast<int>(u_.breaks.size()) - 1, static_cast<int>(v_.breaks.size()) - 1};
  }
  [[nodiscard]] const Cell& cell(int i, int j) const {
    return cells_[static_cast<std::size_t>(i) * (v_.breaks.size() - 1) + j];
  }
  /// Its lengths along u and v.
  [[nodiscard]] std::array<double, 2> sides(int i, int j) const {
    return {u_.breaks[i + 1] - u_.breaks[i], v_.breaks[j + 1] - v_.breaks[j]};
  }
  /// That of a place, -1 beyond the box of parameters.
  [[nodiscard]] std::array<int, 2> cell_of(double u, double v) const;

 private:
  struct Direction {
    double min = 0, max = 0;
    double inverse_step = 0;     ///< 1 / knot step for uniform knots, else 0
    std::vector<double> breaks;  ///< knots within the domain
  };
  void derivatives_of_patch(double u, double v, int place, FourDerivatives& out) const;

  const Patch& patch_;
  Direction u_, v_;
  std::vector<Cell> cells_;  ///< v fastest; none where the patch is not bicubic
};

}  // namespace condyle
