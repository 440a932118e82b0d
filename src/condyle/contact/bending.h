#pragma once

/// How far a surface rises over its osculating quadrics, as far as a search asks: about known
/// contacts shell by shell. What was measured once is kept.

#include <array>
#include <vector>

#include "condyle/contact/cluster_quadrics.h"
#include "condyle/contact/surface_cover.h"

namespace condyle {

/// A point over an osculating quadric nearby.
struct Facing {
  const SurfacePoint* at = nullptr;  ///< the quadric's origin
  double bend = 0;                   ///< a >= 0 with h - ½ tᵀ K t <= ½ a t² [1/mm]
  double error = 0;                  ///< of the gap at the point itself [mm]
  Eigen::Vector3d beside = Eigen::Vector3d::Zero();  ///< of the origin, in the tangent plane [mm]
  double along = 0;                                  ///< of the point over the tangent plane [mm]
};

/// A point over the quadric at a place; nothing is allowed for yet.
[[nodiscard]] Facing over_quadric(const SurfacePoint& at, const Eigen::Vector3d& point);

/// Point p over the quadric of its nearest sample, for the cell of that and as far as the
/// neighbours.
[[nodiscard]] Facing facing_cell(const SurfaceCover& cover, const Eigen::Vector3d& p, int near);

class Bending {
 public:
  static constexpr int kLevels = 9;
  /// Outer radii of the shells [mm], ascending.
  using Radii = std::array<double, kLevels>;

  Bending(const SurfaceCover& cover, const Radii& radii);

  /// Shells in equal ratios, from one that holds the neighbours of a sample to one of radius
  /// `greatest` [mm].
  [[nodiscard]] static Radii shells(double spacing, double greatest);

  /// Of shell `level` about a sample (-1: none), over its own quadric; where the surface bends
  /// evenly, over that with the curvature tensor K. Measured when it is first asked for, each shell
  /// by itself.
  [[nodiscard]] Rise in_shell(int level, int sample, const Eigen::Matrix3d& K);

  /// Asks for shells about that sample, or none, once more: all of them cost more than a search does
  /// without them, so they pay from the second time on since the last reset.
  [[nodiscard]] bool pays(int sample);

  /// Forgets what was asked for; what was measured is the same whenever it is.
  void reset() { ++now_; }

  /// What is added for a point in the cell of the sample, where the curvature tensor is K [1/mm].
  [[nodiscard]] double shift(int sample, const Eigen::Matrix3d& K) const;

  [[nodiscard]] ClusterQuadrics& quadrics() { return quadrics_; }

 private:
  struct Shells {
    std::array<Rise, kLevels> of;
    std::array<bool, kLevels> measured = {};
    int asked = -1;  ///< after which reset
  };

  const SurfaceCover* cover_;
  ClusterQuadrics quadrics_;
  Radii radii_;
  std::vector<Shells> shells_;  ///< of each sample
  int now_ = 0;
};

}  // namespace condyle
