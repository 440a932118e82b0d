#pragma once

/// The closest point of a surface (the foot) to a point that moves little from one question to the
/// next. The foot of a point displaced by v moves by du = (h⁻¹)ᵃᵇ c_b·v, h = a - φ b with the metric
/// a and the second form b, so Newton begins where the foot should be and mostly ends there: one
/// evaluation of the surface. φ and n at the foot are taken to second and first order from the place
/// where the last step began, which is exact to round-off for the steps that end the iteration.

#include <Eigen/Core>

#include "condyle/surface/patch.h"

namespace condyle {

/// In the frame of the body that carries the surface.
struct LayerFoot {
  Place place = Place::Zero();
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< the point whose foot it is [mm]
  double phi = 0;                                ///< its signed distance [mm]
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();  ///< ∂φ, out of the solid
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();   ///< ∂²φ = -K (I - φ K)⁻¹ [1/mm]
  Eigen::Matrix<double, 3, 2> turn =
      Eigen::Matrix<double, 3, 2>::Zero();  ///< of u and v with the point; patches only
  bool known = false;

  /// φ changes by no more than the way of a point: farther off than `radius` it stays so until it
  /// has moved by the rest.
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& now, double radius) const {
    return known && phi > radius && (now - at).squaredNorm() < (phi - radius) * (phi - radius);
  }
  /// The same of being no farther off than `radius`.
  [[nodiscard]] bool is_near(const Eigen::Vector3d& now, double radius) const {
    return known && phi < radius && (now - at).squaredNorm() < (radius - phi) * (radius - phi);
  }
};

class LayerFeet {
 public:
  explicit LayerFeet(const Surface& surface)
      : surface_(surface), patch_(dynamic_cast<const Patch*>(&surface)) {}

  /// The foot of p, searched from that of a point near it, `from`, which may be `foot` itself.
  /// `step`: of the last iteration at most [mm]; φ is then good to its cube, n to its square. Of a
  /// point outside that is known to be, φ may be told too small by a step of 0.2 mm at most.
  void find(const Eigen::Vector3d& p, const LayerFoot& from, double step, LayerFoot& foot) const;

  /// From anywhere.
  void find_anew(const Eigen::Vector3d& p, LayerFoot& foot) const;

 private:
  bool follow(const Eigen::Vector3d& p, Eigen::Vector2d x, double step, LayerFoot& foot) const;
  void find_by_surface(const Eigen::Vector3d& p, const Place& start, LayerFoot& foot) const;

  const Surface& surface_;
  const Patch* patch_;  ///< null where it is none
};

}  // namespace condyle
