#pragma once

/// A bicubic patch as a polynomial in each of its knot cells, c(u, v) = Σ a_kl x^k y^l with x and y
/// from the corner of the cell: for many evaluations, four at once. Sixteen coefficients a cell in
/// place of two rows of basis functions, which is a quarter of the arithmetic and eight times the
/// memory.

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

 private:
  struct Direction {
    double min = 0, max = 0;
    double inverse_step = 0;     ///< 1 / knot step for uniform knots, else 0
    std::vector<double> breaks;  ///< knots within the domain
  };
  struct alignas(32) Cell {
    double a[4][4][4];  ///< [power of u][power of v][coordinate, the last idle]
  };
  static int span(const Direction& direction, double t);
  void derivatives_of_patch(double u, double v, int place, FourDerivatives& out) const;

  const Patch& patch_;
  Direction u_, v_;
  std::vector<Cell> cells_;  ///< v fastest; none where the patch is not bicubic
};

}  // namespace condyle
