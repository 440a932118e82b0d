#pragma once

/// A point of contact between a surface on B (ground) and one on A (moving), linearised for
/// Newton's method [Dortmans 1986, 2.45-2.58, 2.87-2.104; docs/elements.md, docs/equilibrium.md].
///
/// Conditions g = a + s - c = 0 and h = n + m = 0 (c, n, K on B; s = R ĉ, m = R n̂, Kr = R K̂ Rᵀ
/// from A). They determine how the contact point slides on both surfaces when the pose changes by
/// (da, dπ):
///     dc = D0 + D1 da + D2 dπ,   D1 = P Kr,  D2 = -P ([m]x + Kr [s]x),  D0 = P (h + Kr g),
/// with P the inverse of K + Kr in the tangent plane of B. One row stays for the Newton system:
///     n.(g + da + dπ x s) = 0.
/// The force on A is F = p n, its moment about O_A is s x F.
///
/// Across a gap γ = n.g that stays, A touches the surface parallel to B's at the distance γ: points
/// c + γ n, the same normals, curvature K' = K (I - γ K)^-1. The conditions above hold for it as
/// they stand, with K' for K and g - γ n for g; the point on B itself slides by dc + γ K' dc.

#include <array>

#include "condyle/contact/contact_places.h"
#include "condyle/elements/wrench.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct ContactLinearization {
  SurfacePoint B;                   ///< on the fixed body, ground frame
  SurfacePoint A;                   ///< on the moving body, in A's frame
  Eigen::Vector3d s, m;             ///< R ĉ [mm] and R n̂
  Eigen::Vector3d g, h;             ///< distance of the two points [mm] and of the opposite normals
  Eigen::Vector3d arm;              ///< s x n [mm]: the moment of a unit contact force
  Eigen::Matrix<double, 3, 2> T;    ///< unit tangents of B at the contact
  Eigen::Matrix<double, 3, 2> K_T;  ///< K T, of B, or K' T
  Eigen::Matrix<double, 2, 3> S1, S2;  ///< D1 = T S1, D2 = T S2: the slide in tangent coordinates
  Eigen::Vector2d S0;                  ///< D0 = T S0
  /// Principal values of -(K + Kr) in the tangent plane [1/mm], ascending: both positive where the
  /// solids touch in an isolated point.
  std::array<double, 2> relative_curvature;
  double across = 0;  ///< γ [mm]: 0 where the points are to touch

  [[nodiscard]] double gap() const { return B.n.dot(g); }
  [[nodiscard]] Eigen::Matrix3d D1() const;  ///< ∂c/∂a
  [[nodiscard]] Eigen::Matrix3d D2() const;  ///< ∂c/∂π
  /// What brings the two points together at a fixed pose [mm].
  [[nodiscard]] Eigen::Vector3d D0() const;
};

/// Below this magnitude [1/mm] a principal relative curvature counts as zero: the contact is a line
/// or conforming. In that direction nothing says where the point goes: it stays where it is on B,
/// or on A where it lies nearer an edge of A, so that a point at the end of a line stays at the
/// end.
inline constexpr double kFlatCurvature = 1e-9;

/// At an edge, smaller than this part of the other principal relative curvature counts as zero too:
/// a line that is a little tilted or crossed still ends there.
inline constexpr double kFlatAtEdge = 1e-3;

/// Unit tangent [ground frame] in which the relative curvature is smallest: along the line of a
/// line contact, the longer axis of an elastic one.
[[nodiscard]] Eigen::Vector3d direction_of_least_curvature(const ContactLinearization& contact,
                                                           const Eigen::Matrix3d& R_BA);

[[nodiscard]] ContactLinearization linearize_contact(const SurfacePair& surfaces,
                                                     const ContactPlaces& places,
                                                     const RigidTransform& X_BA);

/// The same for points that keep their gap. Beyond a centre of its curvature B has no parallel
/// surface: γ is less than the gap there, nine tenths of the way.
[[nodiscard]] ContactLinearization linearize_across_gap(const SurfacePair& surfaces,
                                                        const ContactPlaces& places,
                                                        const RigidTransform& X_BA);

/// Adds the contact force p [N] with its derivatives, and the part of the force that the residual
/// sliding D0 will bring, so that one Newton step removes g and h as well.
void add_contact_force(const ContactLinearization& contact, double p, Wrench& wrench);

/// Moves both places by what a step (da, dπ) of the pose asks for (call before the pose is
/// updated).
void slide_contact(const SurfacePair& surfaces,
                   ContactPlaces& places,
                   const ContactLinearization& contact,
                   const RigidTransform& X_BA,
                   const Eigen::Vector3d& da,
                   const Eigen::Vector3d& dpi,
                   double longest_slide);

}  // namespace condyle
