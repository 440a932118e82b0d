#pragma once

/// The directions in which an insertion is uncertain: two tangents of its bone and the normal.

#include <Eigen/Core>

#include <optional>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Of the bone at its point nearest to p [mm], out of the bone: area-weighted over the triangles that lie
/// within 2 mm of that point. Empty for a mesh without triangles of any area.
[[nodiscard]] std::optional<Eigen::Vector3d> bone_normal(const TriangleMesh& mesh,
                                                         const Eigen::Vector3d& p);

/// Tangent, tangent, the unit normal n. The first tangent lies along the axis, of the columns of `axes`, that is
/// most at right angles to n; the triad has the handedness of the axes: along the anatomical axes of a bone, whose lateral
/// one is turned round in a left knee, a knee and its mirror image have mirror images of tangents.
[[nodiscard]] Eigen::Matrix3d triad_about(const Eigen::Vector3d& n, const Eigen::Matrix3d& axes);

}  // namespace condyle
