#pragma once

/// The closest point of a surface (the foot) to a point that moves little from one question to the
/// next. The foot of a point displaced by v moves by du = (h⁻¹)ᵃᵇ c_b·v, h = a - φ b with the metric
/// a and the second form b, so Newton begins where the foot should be and mostly ends there: one
/// evaluation of the surface. φ and n at the foot are taken to second and first order from the place
/// where the last step began, which is exact to round-off for the steps that end the iteration.

#include <Eigen/Core>

#include <cmath>

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

  /// Is n the gradient of φ: does p - c go along it?
  bool is_regular = false;
};

/// Where φ of a point may be known from an earlier one. Nowhere does it change by more than the way v
/// that the point went. Where a ball of radius ρ rolls over the surface from outside it is at least
/// φ + n·v - v²/(2(ρ - φ - |v|)), too: 1/(ρ - φ) bounds -∂²φ.
struct PhiBound {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< [mm]
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  double phi = -1;  ///< [mm], unknown below 0
  double room = 0;  ///< ρ - φ, 0 where n is not to be used [mm]

  PhiBound() = default;
  PhiBound(const LayerFoot& foot, double rho)
      : from(foot.at), n(foot.n), phi(foot.phi), room(foot.is_regular ? rho - foot.phi : 0) {}

  /// Is φ > `radius` at p?
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& p, double radius) const {
    const double rest = phi - radius;
    if (!(rest > 0)) return false;
    const Eigen::Vector3d v = p - from;
    const double square = v.squaredNorm();
    if (square < rest * rest) return true;
    const double left = room - std::sqrt(square);
    return left > 0 && 2 * left * (rest + n.dot(v)) > square;
  }
};

class LayerFeet {
 public:
  explicit LayerFeet(const Surface& surface);

  /// Radius of a ball that rolls over the surface from outside: by half of the smallest concave one
  /// seen on it, 0 where it has no bounds [mm].
  [[nodiscard]] double rolling() const { return rolling_; }

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
  double rolling_;      ///< [mm]
};

}  // namespace condyle
