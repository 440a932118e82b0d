#pragma once

/// The path over one surface, its end free of it, frame of the surface [mm]: closed forms for sphere
/// and cylinder, else Newton with the explicit step.

#include <Eigen/Core>

#include <optional>

#include "condyle/wrapping/wrap_shape.h"

namespace condyle {

/// Where the geodesic begins, its tangent there, its length: what is kept from pose to pose.
struct ArcPlace {
  Eigen::Vector3d P, t;
  double arc;
};

/// Where the geodesic of a place ends: with it the next pose's first step needs none to be followed.
struct ArcEnd {
  Eigen::Vector3d Q, t;
  double a, da, r, dr;
  double size =
      0;  ///< of the step that was taken since the geodesic was followed; the error is of its square
};

/// Of the last step on a path, in angles and parts of the least radius: below it the path is as good as
/// double precision, or as what is wanted far from a solution.
inline constexpr double kSmallStep = 1e-8, kRoughStep = 1e-4;

struct OneSurfacePath {
  double length = 0;
  double l1 = 0, l2 = 0;           ///< X to P, Q to Y
  Eigen::Vector3d e_X, e_Y;        ///< unit tangents at X and Y, from X to Y
  Eigen::Vector3d n, b, n_Q, b_Q;  ///< at P and Q
  double A = 0, B = 0, D = 0;      ///< B = A l1 + r + l2 r', A = a + l2 a', D = a' l1 + r'
  bool found = false;
  bool shortest = false;  ///< B > 0, no conjugate point of X before Y

  /// ∂²L/∂X² and ∂²L/∂Y² [1/mm] in the frame to which R turns that of the surface.
  [[nodiscard]] Eigen::Matrix3d H_XX(const Eigen::Matrix3d& R) const {
    return H(R * n, 1 / l1, R * b, A / B);
  }
  [[nodiscard]] Eigen::Matrix3d H_YY(const Eigen::Matrix3d& R) const {
    return H(R * n_Q, 1 / l2, R * b_Q, D / B);
  }

 private:
  static Eigen::Matrix3d H(const Eigen::Vector3d& in,
                           double by_turn,
                           const Eigen::Vector3d& aside,
                           double by_shift) {
    return in * (by_turn * in).transpose() + aside * (by_shift * aside).transpose();
  }
};

/// From the place as it is: of a sphere only its plane is looked at where the ends leave it open, of a
/// cylinder the sense and the nearest angle. The place is that of the path afterwards. `end`, if any,
/// belongs to the place, before and after; of sphere and cylinder there is none. `anchored`: X is on
/// the surface and the path begins there; then l1 = 0, and ∂²L/∂X² is not to be asked for. `small`: the last
/// step.
[[nodiscard]] OneSurfacePath path_over(const WrapShape& shape,
                                       const Eigen::Vector3d& X,
                                       const Eigen::Vector3d& Y,
                                       bool anchored,
                                       ArcPlace& place,
                                       std::optional<ArcEnd>& end,
                                       double small = kSmallStep);

}  // namespace condyle
