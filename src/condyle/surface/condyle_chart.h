#pragma once

/// The chart of a femoral condyle: a tube of circular section about a line within the condyle.
///
/// Height over a cylinder about the condylar axis folds where the condyle turns into the notch.
/// Seen from a line inside the condyle, about 1.3 of its half-widths below its crest, both flanks
/// stay in sight. The line follows the condyle: its place along the condylar axis and its distance
/// from it are polynomials in the angle about the axis, fitted to the crest by least squares.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

/// Coordinates about the condylar axis.
struct AboutAxis {
  double angle;            ///< 0 distal, + posterior [rad]
  double radius;           ///< distance from the axis [mm]
  double along;            ///< from the plane between the condyles, + lateral [mm]
  Eigen::Vector3d radial;  ///< unit, away from the axis
};
[[nodiscard]] AboutAxis about_axis(const CondylarAxis& axis, const Eigen::Vector3d& p);

class CondyleChart {
 public:
  /// Follows the vertices of `crest` triangles, the part of `mesh` that faces away from the axis;
  /// `unit_radius` [mm] makes angles lengths. Throws InputError where there are too few.
  CondyleChart(const TriangleMesh& mesh,
               const std::vector<bool>& crest,
               const CondylarAxis& axis,
               double unit_radius);

  /// (u, v) [mm]: way about the axis at `unit_radius`, about the way across the condyle.
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector3d& p) const;
  /// Unit, away from the line within the condyle.
  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector3d& p) const;

 private:
  static constexpr int kTerms = 5;
  using Terms = Eigen::Matrix<double, kTerms, 1>;
  /// From the line to p: along the axis and away from it [mm].
  [[nodiscard]] Eigen::Vector2d from_line(const AboutAxis& q) const;
  [[nodiscard]] Terms powers(double angle) const;

  CondylarAxis axis_;
  double unit_radius_;
  double tube_ = 0;               ///< [mm]
  double middle_ = 0, half_ = 1;  ///< of the angles of the crest [rad]
  Terms along_ = Terms::Zero(), radius_ = Terms::Zero();
};

}  // namespace condyle
