#pragma once

/// The wrench of an elastic layer on the moving body, with its exact derivatives: material points
/// of one surface, each with the area w it stands for, pressed into the other by the signed
/// distance φ of its closest point. With W the energy of an area at depth -φ (layer_law.h), p = W',
///     U = Σ w W(-φ),   f = -∂U/∂a,   m = -∂U/∂π.
/// Points x = a + s fixed on A, closest point on B with normal n and curvature tensor K, the second
/// derivative of φ being H = -K (I - φ K)⁻¹ in the tangent plane: f = p n, m = s x f, and with
/// G = p H - W'' n nᵀ
///     F1 = Σ w G,  F2 = -Σ w G [s]x,  M1 = Σ w [s]x G,  M2 = Σ w (-[s]x G [s]x + [f]x [s]x).
/// Points y = a + s fixed on B, closest point on A, n its normal in the ground frame: f = -p n,
///     F1 = Σ w G,  F2 = -Σ w (G [s]x + [f]x),  M1 = Σ w ([s]x G + [f]x),
///     M2 = -Σ w ([s]x G [s]x + [s]x [f]x).
/// W(0) = W'(0) = 0 leaves the moving edge of the contact no part in the first two derivatives.

#include <Eigen/Core>

#include <array>
#include <vector>

#include "condyle/contact/contact_result.h"
#include "condyle/contact/layer_corner_sums.h"
#include "condyle/contact/layer_lattice.h"
#include "condyle/contact/layer_law.h"
#include "condyle/contact/layer_packets.h"
#include "condyle/elements/wrench.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

/// What the pressed points amount to.
struct LayerSums {
  int points = 0;     ///< in contact
  double energy = 0;  ///< U [N mm]
  double area = 0;    ///< in contact [mm²]
  double force = 0;   ///< Σ w p [N]
  double beyond = 0;  ///< of it, of points that face what lies beyond the other's edge [N]
  double faded = 0;   ///< what the border at an edge took of the force [N]
  Eigen::Vector3d lost_moment = Eigen::Vector3d::Zero();  ///< Σ x of either, by their forces [N mm]
  double deepest = 0;                                     ///< greatest depth [mm]
  double peak_pressure = 0;                               ///< [N/mm²]
  Eigen::Vector3d peak = Eigen::Vector3d::Zero();         ///< where, ground frame [mm]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();      ///< there, out of B, ground frame
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< Σ w p x, x in the ground frame [N mm]
  Eigen::Vector3d on_A = Eigen::Vector3d::Zero();    ///< force on A, ground frame [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< its moment about the origin of B [N mm]

  /// Σ w p x / Σ w p [mm].
  [[nodiscard]] Eigen::Vector3d center_of_pressure() const { return moment / force; }
};

/// How what the pressed points amount to changes; see contact_rates.h.
struct LayerRateSums {
  Eigen::Matrix<double, 1, 6> force = Eigen::Matrix<double, 1, 6>::Zero();  ///< of Σ w p by (a, π)
  Eigen::Matrix<double, 3, 6> moment = Eigen::Matrix<double, 3, 6>::Zero();  ///< of Σ w p x
  /// By ln E of the layer of a surface.
  struct Stiffer {
    double force = 0;                                  ///< of Σ w p [N]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of Σ w p x [N mm]
    Eigen::Vector3d f = Eigen::Vector3d::Zero(), m = Eigen::Vector3d::Zero();  ///< of the wrench
  };
  std::array<Stiffer, 2> stiffer;  ///< on B, on A
};

/// Points of one body, pressed into a surface of the other. Keeps closest points from pose to pose,
/// and the points that are pressed until it is asked for another pose; one thread.
class LayerSide {
 public:
  /// Points of A pressed into B's surface, or the other way round. All is referred to.
  LayerSide(const LayerLattice& points, bool of_A, const LayerClosestPoints& into);

  /// As newly made. Allocates nothing.
  void reset();

  /// Adds `share` of what the points amount to. Allocates nothing.
  void add_to(const RigidTransform& X_BA, const LayerLaw& law, double share, LayerSums& sums);

  /// Adds `share` of the wrench on A; returns the sum of the forces' magnitudes [N]. Allocates
  /// nothing.
  double add_to(const RigidTransform& X_BA,
                const LayerLaw& law,
                double share,
                LayerCare care,
                Wrench& wrench);

  /// The force on A that the corners of the points' cells would carry [N] (layer_corner_sums.h), with
  /// the sum of the magnitudes. Allocates nothing once it was asked.
  CornerForce at_corners(const RigidTransform& X_BA,
                         const LayerLaw& law,
                         const LayerCorners& corners);

  /// Adds `share` of how that changes. Allocates nothing.
  void add_to(const RigidTransform& X_BA, const LayerLaw& law, double share, LayerRateSums& sums);

  /// How many points are pressed.
  [[nodiscard]] std::size_t pressed(const RigidTransform& X_BA);

  [[nodiscard]] long looked_at() const { return packets_.looked_at(); }

  /// Is any point within `margin` of the other surface, or in it [mm]?
  [[nodiscard]] bool comes_within(const RigidTransform& X_BA, double margin);

  /// Appends the points that are pressed.
  void add_pressures(const RigidTransform& X_BA,
                     const LayerLaw& law,
                     std::vector<PressurePoint>& points);

 private:
  const LayerPackets& press_at(const RigidTransform& X_BA, LayerCare care);
  template <typename Each>
  void for_pressed(const RigidTransform& X_BA, const Each& each);
  const LayerLattice& points_;
  bool of_A_;
  const Surface& into_;
  LayerPackets packets_;
  LayerCornerSums corners_;
};

}  // namespace condyle
