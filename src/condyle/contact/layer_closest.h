#pragma once

/// The closest point of a surface to a point that moves little from one question to the next. That
/// of a point displaced by v moves by du = (h⁻¹)ᵃᵇ c_b·v, h = a - φ b with the metric a and the
/// second form b, so Newton begins where the closest point should be and mostly ends there: one
/// evaluation of the surface. φ and n there are taken to second and first order from the place where
/// the last step began, which is exact to round-off for the steps that end the iteration.

#include <Eigen/Core>

#include <cmath>

#include "condyle/surface/patch.h"

namespace condyle {

/// In the frame of the body that carries the surface.
struct LayerClosestPoint {
  Place place = {Eigen::Vector3d::Zero()};
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< the point whose closest point it is [mm]
  double phi = 0;                                ///< its signed distance [mm]
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();  ///< ∂φ, out of the solid
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();   ///< ∂²φ = -K (I - φ K)⁻¹ [1/mm]
  Eigen::Matrix<double, 3, 2> turn =
      Eigen::Matrix<double, 3, 2>::Zero();  ///< of u and v with the point; patches only
  bool known = false;
};

/// Where φ of a point may be known from an earlier one: nowhere does it change by more than the way
/// that the point went.
struct PhiBound {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< [mm]
  double phi = -1;                                 ///< [mm], unknown below 0

  PhiBound() = default;
  explicit PhiBound(const LayerClosestPoint& closest) : from(closest.at), phi(closest.phi) {}

  /// Is φ > `radius` at p?
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& p, double radius) const {
    const double rest = phi - radius;
    return rest > 0 && (p - from).squaredNorm() < rest * rest;
  }
};

class LayerClosestPoints {
 public:
  explicit LayerClosestPoints(const Surface& surface);

  /// The closest point of p, searched from that of a point near it, `from`, which may be `closest`
  /// itself. `step`: of the last iteration at most [mm]; φ is then good to its cube, n to its square. Of
  /// a point outside that is known to be, φ may be told too small by a step of 0.2 mm at most.
  void find(const Eigen::Vector3d& p,
            const LayerClosestPoint& from,
            double step,
            LayerClosestPoint& closest) const;

  /// From anywhere.
  void find_anew(const Eigen::Vector3d& p, LayerClosestPoint& closest) const;

 private:
  bool follow(const Eigen::Vector3d& p,
              Eigen::Vector2d x,
              double step,
              LayerClosestPoint& closest) const;
  void find_by_surface(const Eigen::Vector3d& p,
                       const Place& start,
                       LayerClosestPoint& closest) const;

  const Surface& surface_;
  const Patch* patch_;  ///< null where it is none
};

}  // namespace condyle
