#pragma once

/// Mass, mass centre and inertia of a body, in the body's frame [tonne, mm].
///
/// J_G = ∫ R Rᵀ dm about the mass centre G; about another point J_0 = J_G + m R_0G R_0Gᵀ
/// [Tokad 1992, 16-22].

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct PointMass {
  double mass = 0;                                     ///< [tonne]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< body frame [mm]
};

struct MassProperties {
  double mass = 0;                                    ///< [tonne]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< G, body frame [mm]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< J_G [tonne mm²]
};

/// Of the solid that a closed mesh encloses, of uniform density [tonne/mm³]. Throws InputError,
/// naming `what`, for a mesh that is open or encloses nothing.
[[nodiscard]] MassProperties mass_of_solid(const TriangleMesh& mesh,
                                           double density,
                                           const std::string& what);

/// Of point masses; their sum must be positive. With the next three the identities of the paper,
/// which tests hold the mass of a mesh against.
[[nodiscard]] MassProperties mass_of_points(const std::vector<PointMass>& points);

/// J_0 about a point of the body frame [tonne mm²].
[[nodiscard]] Eigen::Matrix3d inertia_about(const MassProperties& body,
                                            const Eigen::Vector3d& point);

/// I_0 = ∫ r² dm = tr J_0 / 2 about a point of the body frame [tonne mm²].
[[nodiscard]] double polar_inertia_about(const MassProperties& body, const Eigen::Vector3d& point);

/// Point masses with the same mass, centre and inertia: a sixth of the mass on either side of G on
/// each principal axis.
[[nodiscard]] std::array<PointMass, 6> equimomental_points(const MassProperties& body);

}  // namespace condyle
