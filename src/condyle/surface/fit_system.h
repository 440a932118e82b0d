#pragma once

/// The linear half of a fit: with parameters held fixed, the control points of least
///     Σ w_i |c(u_i, v_i) - p_i|² + ℓ⁶ ∫ |∇³c|² dA + ℓ⁴ ∫_outside |∇²c|² dA.
/// Derivatives and areas are taken per mm of the surface, so that the smoothing length ℓ [mm]
/// neither depends on the mesh nor on the chart. The last term acts only where there are no data:
/// the patch goes on without bending.

#include <Eigen/Core>

#include <vector>

#include "condyle/surface/banded_cholesky.h"
#include "condyle/surface/patch.h"

namespace condyle {

/// Degree and uniform knots of a patch under construction.
struct SplineGrid {
  int degree = 3;
  int nu = 0, nv = 0;  ///< control points
  double u_min = 0, u_max = 1, v_min = 0, v_max = 1;

  [[nodiscard]] int cells_u() const { return nu - degree; }
  [[nodiscard]] int cells_v() const { return nv - degree; }
  [[nodiscard]] double step_u() const { return (u_max - u_min) / cells_u(); }
  [[nodiscard]] double step_v() const { return (v_max - v_min) / cells_v(); }
  [[nodiscard]] int size() const { return nu * nv; }
  [[nodiscard]] int band() const { return degree * nv + degree; }
};

/// One knot cell: how its chart is stretched on the surface and whether it holds data; v fastest.
struct CellMetric {
  double stretch_u = 1, stretch_v = 1;  ///< mm of surface per unit of parameter
  double smoothing = 1;                 ///< the smoothing length here as a fraction of ℓ
  double bending = 1;                   ///< that of the second penalty, where there are no data
  bool known = true;
};

struct DataPoint {
  Eigen::Vector3d p;   ///< [mm]
  Eigen::Vector2d uv;  ///< its parameters, within the grid
  double weight;       ///< area [mm²]
};

/// Normal equations of the data: matrix and right-hand side [size x 3].
struct DataTerm {
  BandedMatrix matrix;
  Eigen::MatrixXd right;
};
[[nodiscard]] DataTerm assemble_data(const SplineGrid& grid, const std::vector<DataPoint>& points);

/// The two penalties without their factors ℓ⁶ and ℓ⁴.
struct PenaltyTerm {
  BandedMatrix third;
  BandedMatrix second_outside;
};
[[nodiscard]] PenaltyTerm assemble_penalty(const SplineGrid& grid,
                                           const std::vector<CellMetric>& cells);

/// Control points, v fastest. Throws InputError where the data do not determine them.
[[nodiscard]] std::vector<Eigen::Vector3d> solve_fit(const DataTerm& data,
                                                     const PenaltyTerm& penalty,
                                                     double smoothing_length);

/// Condition number of the system that solve_fit solves.
[[nodiscard]] double fit_condition(const DataTerm& data,
                                   const PenaltyTerm& penalty,
                                   double smoothing_length);

/// The grid with its control points as a patch; no mask yet.
[[nodiscard]] PatchData patch_data(const SplineGrid& grid,
                                   std::vector<Eigen::Vector3d> control_points);

}  // namespace condyle
