#pragma once

/// A quadric between two surfaces that touch or nearly do: what lies wholly on its own side of it
/// overlaps nothing that lies wholly on the other.
///
/// φ(p) = n·d - b·d - ½ dᵀ M d with d = p - o, b·n = 0 and M n = 0: a height over the quadric, whose
/// graph over the plane through o parts all of space. It is laid midway between quadrics fitted to
/// both surfaces; where they conform it is nearer to both than any paraboloid of revolution.

#include <Eigen/Core>

#include <vector>

#include "condyle/contact/quadric_fit.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct DividingQuadric {
  Eigen::Vector3d o, n, b;  ///< point [mm], unit normal, slope
  Eigen::Matrix3d M;        ///< [1/mm]
  double least, greatest;   ///< principal values of M in the plane, with 0 [1/mm]
};

/// Midway between two quadrics whose normals are about opposite, in one frame; n is that of the
/// lower one, `o` a point near both [mm].
[[nodiscard]] DividingQuadric divide(const SurfacePoint& lower,
                                     const SurfacePoint& upper,
                                     const Eigen::Vector3d& o);

/// The same quadric in another frame.
[[nodiscard]] DividingQuadric moved(const DividingQuadric& quadric, const RigidTransform& X);

/// Cells of a surface in columns, four at a time.
class CellColumns {
 public:
  void reserve(std::size_t cells);
  /// A cell of that radius [mm] about a point whose greatest principal curvature is nowhere above
  /// `bend` [1/mm].
  void add(const SurfacePoint& at, double radius, double bend);

  enum class Side { kBelow, kAbove };
  /// The cells that are not shown to lie wholly on their side of the quadric, ascending.
  void not_on(Side side, const DividingQuadric& quadric, std::vector<int>& cells) const;

 private:
  enum Column { kX, kY, kZ, kNx, kNy, kNz, kRadius, kBend, kColumns };
  int size_ = 0;
  std::vector<double> numbers_;  ///< [group of four cells][column][4]
};

}  // namespace condyle
