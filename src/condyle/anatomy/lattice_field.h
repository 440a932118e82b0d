#pragma once

/// A smooth field of displacements: cubic B-splines on a lattice (free-form deformation) [Rueckert
/// 1999], fitted to pairs of surface points by linear least squares against its bending.

#include <Eigen/Core>

#include <array>
#include <vector>

#include "condyle/anatomy/surface_pairs.h"

namespace condyle {

/// What a field costs beside its misfit, mean square gap [mm²]:
///
///   bending (mean |D²u|² + mean |Du|²/reach²)
///
/// so that beyond the surfaces it fades to a shift within `reach`.
struct FieldStiffness {
  double bending = 1e4;  ///< [mm⁴]
  double reach = 25;     ///< [mm]
  double along = 0.02;   ///< cost of a pair's distance along the surface, to that of its gap [-]
};

class LatticeField {
 public:
  /// Zero, on cells of edge `spacing` over a box [mm].
  LatticeField(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double spacing);

  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& p) const;
  /// Derivatives of the displacement: column k by coordinate k [-].
  [[nodiscard]] Eigen::Matrix3d gradient(const Eigen::Vector3d& p) const;
  /// The field that takes `from` of each pair best onto the plane of the other surface.
  void fit(const std::vector<PointPair>& pairs, const FieldStiffness& stiffness);

 private:
  struct Place {
    std::array<int, 3> cell;
    Eigen::Vector3d fraction;
  };
  [[nodiscard]] Place place(const Eigen::Vector3d& p) const;
  [[nodiscard]] int node(int i, int j, int k) const { return (i * n_[1] + j) * n_[2] + k; }
  [[nodiscard]] Eigen::MatrixXd bending_matrix(const FieldStiffness& stiffness) const;

  Eigen::Vector3d low_;
  double spacing_;
  std::array<int, 3> n_;                        ///< nodes along each axis, longest first
  std::array<int, 3> axis_;                     ///< which coordinate each of them runs along
  Eigen::Matrix<double, 3, Eigen::Dynamic> c_;  ///< displacement of each node [mm]
};

}  // namespace condyle
