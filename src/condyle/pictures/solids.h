#pragma once

/// Small solids that a knee is drawn with: tubes, balls and arrows, as shaded triangles. Lengths in
/// mm.

#include <vector>

#include "condyle/pictures/shaded_mesh.h"

namespace condyle {

struct TubePoint {
  Eigen::Vector3d center;
  double radius = 1;
  Paint paint;
};

/// A tube with round ends along a line of at least two points, no two following ones equal.
[[nodiscard]] ShadedMesh tube(const std::vector<TubePoint>& line);

[[nodiscard]] ShadedMesh ball(const Eigen::Vector3d& center, double radius, const Paint& paint);

/// From tail to head; the tip is a cone of at most half the length.
[[nodiscard]] ShadedMesh arrow(const Eigen::Vector3d& tail,
                               const Eigen::Vector3d& head,
                               double radius,
                               const Paint& paint);

}  // namespace condyle
