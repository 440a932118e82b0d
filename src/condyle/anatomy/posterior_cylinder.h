#pragma once

/// One cylinder through both posterior condyles: the flexion axis of a femur [Miranda 2010].

#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

struct PosteriorCylinder {
  Eigen::Vector3d middle;     ///< on the axis, midway between the condyles [mm]
  Eigen::Vector3d direction;  ///< unit, along the `lateral` of the frame that the fit began with
  double radius = 0;          ///< [mm]
  double rms = 0;             ///< of the posterior condyles from it [mm]
};

/// Refines `start`, whose two radii become one. Samples are what lies near the cylinder between 20 and
/// 110 degrees behind distal.
[[nodiscard]] PosteriorCylinder fit_posterior_cylinder(const TriangleMesh& mesh,
                                                       const std::vector<Eigen::Vector3d>& normals,
                                                       const CondylarAxis& start);

}  // namespace condyle
