#pragma once

/// What the exact surfaces share: checks of what they are built from, a local search and even
/// samples. Lengths in mm.

#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "condyle/surface/surface.h"

namespace condyle {

/// The unit vector along v, or `otherwise` where v vanishes.
[[nodiscard]] inline Eigen::Vector3d unit_or(const Eigen::Vector3d& v,
                                             const Eigen::Vector3d& otherwise) {
  const double square = v.squaredNorm();
  if (!(square > 1e-200)) return otherwise;
  return v / std::sqrt(square);
}

/// Each gives back what it was given (a direction as a unit vector) or throws InputError that calls
/// it `what`.
[[nodiscard]] Eigen::Vector3d checked_direction(const Eigen::Vector3d& direction, const char* what);
[[nodiscard]] double checked_length(double length, const char* what);
[[nodiscard]] double checked_bound(double bound, const char* what);  ///< may be infinite
[[nodiscard]] Eigen::Matrix3d checked_axes(const Eigen::Matrix3d& axes, const char* what);

/// The place near `start` where the distance to p has a local minimum: Newton in the tangent plane
/// with the Hessian I - (n.(p - c)) K of half the squared distance, kept a descent by shifting it
/// and by shortening steps.
[[nodiscard]] Place closest_by_newton(const Surface& surface,
                                      const Eigen::Vector3d& p,
                                      const Place& start);

/// Points on rings round the longest axis, evenly along the meridian and along each ring.
[[nodiscard]] std::vector<Place> ellipsoid_samples(const Eigen::Vector3d& center,
                                                   const Eigen::Matrix3d& axes,
                                                   const Eigen::Vector3d& semi_axes,
                                                   double spacing);
[[nodiscard]] std::vector<Place> torus_samples(const Eigen::Vector3d& center,
                                               const Eigen::Vector3d& axis,
                                               double major,
                                               double minor,
                                               double spacing);

/// Points (x, y) of a disc on rings about its centre, the outermost on its edge.
[[nodiscard]] std::vector<Eigen::Vector2d> disc_samples(double radius, double spacing);
/// The first ring stands at one end of the axis, the last at the other.
[[nodiscard]] std::vector<Place> cylinder_samples(const Eigen::Vector3d& center,
                                                  const Eigen::Vector3d& axis,
                                                  double radius,
                                                  double length,
                                                  double spacing);

}  // namespace condyle
