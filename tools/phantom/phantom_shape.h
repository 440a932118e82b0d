#pragma once

/// The phantom knee: distal femur and proximal tibia of a right knee as smooth implicit shapes, f <
/// 0 inside, so that the exact surface, its normals and its curvatures are known. docs/phantom.md
/// gives formulae and sources.
///
/// Both bones in one frame at full extension: x anterior, y proximal, z lateral, origin midway
/// between the centres of the two posterior condyles. Lengths in mm.

#include <Eigen/Core>

#include "condyle/surface/surface.h"
#include "phantom/phantom_parameters.h"

namespace condyle::phantom {

enum class Bone { kFemur, kTibia };

/// f with its exact derivatives.
struct ShapeValue {
  double f;           ///< near the surface about the distance to it [mm]; negative inside
  Eigen::Vector3d g;  ///< ∇f
  Eigen::Matrix3d h;  ///< ∇∇f [1/mm]
};

/// Size and place of a bone: p = rise + S q of a point q of the shape before it is sized.
[[nodiscard]] Eigen::Vector3d sized(Bone bone, const Eigen::Vector3d& q, const PhantomParameters&);
[[nodiscard]] Eigen::Vector3d unsized(Bone bone,
                                      const Eigen::Vector3d& p,
                                      const PhantomParameters&);

[[nodiscard]] double shape(Bone bone,
                           const Eigen::Vector3d& p,
                           const PhantomParameters& knee = kShippedPhantom);
[[nodiscard]] ShapeValue shape_derivatives(Bone bone,
                                           const Eigen::Vector3d& p,
                                           const PhantomParameters& knee = kShippedPhantom);

/// The point of the exact surface closest to p, for p within a few mm of it.
[[nodiscard]] Eigen::Vector3d project(Bone bone,
                                      const Eigen::Vector3d& p,
                                      const PhantomParameters& knee = kShippedPhantom);

/// Unit normal out of the bone at a point of the surface.
[[nodiscard]] Eigen::Vector3d normal(Bone bone,
                                     const Eigen::Vector3d& c,
                                     const PhantomParameters& knee = kShippedPhantom);

/// Curvature tensor K at a point of the surface [1/mm], dn = -K dc.
[[nodiscard]] Eigen::Matrix3d curvature(Bone bone,
                                        const Eigen::Vector3d& c,
                                        const PhantomParameters& knee = kShippedPhantom);

/// Point, normal and curvature at the surface point closest to p. `dual` is left zero: the shape
/// has no chart.
[[nodiscard]] SurfacePoint surface_point(Bone bone,
                                         const Eigen::Vector3d& p,
                                         const PhantomParameters& knee = kShippedPhantom);

/// A box that holds the bone.
struct Box {
  Eigen::Vector3d low, high;
};
[[nodiscard]] Box bounds(Bone bone, const PhantomParameters& knee = kShippedPhantom);

/// Names as used in files and messages.
[[nodiscard]] const char* bone_name(Bone bone);

}  // namespace condyle::phantom
