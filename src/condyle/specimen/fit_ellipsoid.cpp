#include "condyle/specimen/fit_ellipsoid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/math/decompositions.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// As much misfit [mm rms] as semi-axes that differ by a factor e from their mean: far less than
/// bones leave, so that it decides only where flat or small regions leave a semi-axis open.
constexpr double kRound = 0.1;

struct Ellipsoid {
  RigidTransform placement;
  Vector3d semi_axes;
};

/// Moved by dx and turned by the rotation vector dω, both in its own frame, its semi-axes times
/// exp(ds).
Ellipsoid changed(const Ellipsoid& e, const Vector9d& step) {
  Ellipsoid out = e;
  out.placement.p += e.placement.R * step.segment<3>(0);
  out.placement.R = orthonormalized(e.placement.R * exp_rotation(step.segment<3>(3)));
  out.semi_axes = e.semi_axes.array() * step.segment<3>(6).array().exp();
  return out;
}

struct Distances {
  double squares = 0, max = 0;  ///< Σ d² [mm²], max |d| [mm]
  double cost = 0;              ///< with what rounder ellipsoids are preferred by
  Matrix9d JJ = Matrix9d::Zero();
  Vector9d Jd = Vector9d::Zero();
};

/// Of the points, outside positive. The closest point c of the ellipsoid, of normal n, moves with it
/// by dx + dω x c + c ds, and along n that counts: dd = -n·dx - (c x n)·dω - Σ n_i c_i ds_i.
Distances measured(const std::vector<Vector3d>& points, const Ellipsoid& e) {
  Distances sum;
  const auto surface = make_ellipsoid(Vector3d::Zero(), Matrix3d::Identity(), e.semi_axes, true);
  for (const Vector3d& point : points) {
    const Vector3d p = e.placement.R.transpose() * (point - e.placement.p);
    const SurfacePoint at = surface->evaluate(surface->closest(p, surface->seed(p)));
    const Vector3d &c = at.c, &n = at.n;
    const double d = n.dot(p - c);
    Vector9d J;
    J << -n, n.cross(c), -n.cwiseProduct(c);
    sum.squares += d * d;
    sum.max = std::max(sum.max, std::abs(d));
    sum.JJ += J * J.transpose();
    sum.Jd += d * J;
  }
  // Rounder where the points do not say: ds_i against their mean.
  const double weight = kRound * kRound * static_cast<double>(points.size());
  const Vector3d s = e.semi_axes.array().log();
  const Vector3d off = s.array() - s.mean();
  const Matrix3d P = Matrix3d::Identity() - Matrix3d::Constant(1.0 / 3);
  sum.cost = sum.squares + weight * off.squaredNorm();
  sum.JJ.bottomRightCorner<3, 3>() += weight * P;
  sum.Jd.tail<3>() += weight * off;
  return sum;
}

}  // namespace

EllipsoidFit fit_ellipsoid(const std::vector<Vector3d>& points,
                           const RigidTransform& start,
                           double radius) {
  // Levenberg-Marquardt, scaled by the diagonal: until no step promises more than rounding of the cost, which leaves
  // 1e-5 mm where semi-axes are hardly determined. There Gauss-Newton alone would overshoot for ever.
  constexpr int kIterations = 500;
  constexpr double kLeast = 1e-15, kStiffest = 1e12, kLongest = 0.5, kPoor = 0.25, kGood = 0.75;
  EllipsoidFit fit;
  Ellipsoid e{start, Vector3d::Constant(radius)};
  Distances now = measured(points, e);
  double damping = 1e-2;
  for (int i = 0; i < kIterations && !fit.found; ++i) {
    Matrix9d A = now.JJ;
    A.diagonal() += damping * (now.JJ.diagonal().array() + 1e-9).matrix();
    const Vector9d step = -symmetric_solution(A, now.Jd);
    const double promised = -step.dot(now.Jd);
    const bool small = step.tail<6>().cwiseAbs().maxCoeff() < kLongest;
    const Ellipsoid next = small ? changed(e, step) : e;
    const Distances there = small ? measured(points, next) : now;
    const double gain = small ? (now.cost - there.cost) / promised : -1;
    if (gain >= 0) e = next, now = there;
    if (gain < kPoor) damping *= 4;
    if (gain > kGood) damping = std::max(damping / 5, 1e-12);
    fit.found = (small && promised <= kLeast * now.cost) || damping > kStiffest;
  }
  fit.placement = e.placement;
  fit.semi_axes = e.semi_axes;
  fit.rms = std::sqrt(now.squares / static_cast<double>(points.size()));
  fit.max = now.max;
  return fit;
}

}  // namespace condyle
