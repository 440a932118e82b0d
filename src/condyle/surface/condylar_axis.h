#pragma once

/// The common axis of the two posterior condyles, about which they are nearly circular.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Anatomical directions of a bone: unit vectors and an origin in the frame of its mesh [mm]. The
/// triad is left-handed for a left knee, since `lateral` is lateral on both sides.
struct BoneFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d lateral, anterior, proximal;

  /// (anterior, proximal, lateral) components of a vector.
  [[nodiscard]] Eigen::Vector3d components(const Eigen::Vector3d& v) const {
    return {anterior.dot(v), proximal.dot(v), lateral.dot(v)};
  }
  /// The vector that has such components.
  [[nodiscard]] Eigen::Vector3d vector(const Eigen::Vector3d& c) const {
    return anterior * c.x() + proximal * c.y() + lateral * c.z();
  }
};

struct CondylarAxis {
  Eigen::Vector3d point;              ///< on the axis [mm]
  Eigen::Vector3d direction;          ///< unit, towards lateral
  Eigen::Vector3d distal, posterior;  ///< unit, at right angles to it: angles 0 and 90 degrees
  double medial_radius = 0, lateral_radius = 0;  ///< of the posterior condyles [mm]
  double split = 0;     ///< between the condyles, along the axis from `point` [mm]
  double coverage = 0;  ///< share of the posterior arcs, medial and lateral, that the mesh fills
  double rms = 0;       ///< of the posterior condyles from the two cylinders [mm]
};

/// Robust fit of two coaxial cylinders to the posterior condyles of a femur whose mesh faces
/// outward. `normals` are those of the vertices. Throws InputError where no condyles can be made
/// out.
[[nodiscard]] CondylarAxis fit_condylar_axis(const TriangleMesh& mesh,
                                             const std::vector<Eigen::Vector3d>& normals,
                                             const BoneFrame& frame);

/// Where the projection of a set of points on a line has its widest gap in the middle half of their
/// extent.
struct Gap {
  double center = 0, width = 0;  ///< [mm]
};
[[nodiscard]] Gap widest_gap(std::vector<double> positions);

}  // namespace condyle
