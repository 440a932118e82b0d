#include "condyle/contact/layer_closest.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "condyle/math/simd.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// What one evaluation of a patch says of the closest point of a point.
struct ClosestStep {
  Vector2d step;   ///< of u and v, towards the closest point
  double length;   ///< of it [mm]
  bool is_convex;  ///< is the squared distance, well enough for Newton?
};

/// A step at (u, v), and what the closest point is where it ends.
CONDYLE_FMA_CLONE
ClosestStep step_to_closest(const PatchDerivatives& d,
                            const Vector3d& p,
                            int orientation,
                            LayerClosestPoint& closest) {
  const Vector3d q = p - d.c, N = d.c_u.cross(d.c_v);
  const double a = d.c_u.squaredNorm(), b = d.c_u.dot(d.c_v), c = d.c_v.squaredNorm();
  const double square = std::max(a * c - b * b, 1e-300), inverse = 1 / square;
  const Vector3d n = N * (orientation * std::sqrt(inverse));
  // Of the squared distance: gradient -q·c_a, second derivatives h; the second form is n·c_ab.
  const double q_u = q.dot(d.c_u), q_v = q.dot(d.c_v);
  const double h_uu = a - q.dot(d.c_uu), h_uv = b - q.dot(d.c_uv), h_vv = c - q.dot(d.c_vv);
  const double b_uu = n.dot(d.c_uu), b_uv = n.dot(d.c_uv), b_vv = n.dot(d.c_vv);
  const double det = h_uu * h_vv - h_uv * h_uv, over = 1 / det;
  ClosestStep result;
  result.is_convex = h_uu > 0.05 * a && det > 0.0025 * a * c;
  const double s = (h_vv * q_u - h_uv * q_v) * over, t = (h_uu * q_v - h_uv * q_u) * over;
  result.step = {s, t};
  result.length = std::sqrt(a * s * s + c * t * t);
  const Vector3d g_u = (c * d.c_u - b * d.c_v) * inverse, g_v = (a * d.c_v - b * d.c_u) * inverse;
  // Shares of the step by the second form: of the turn of n, and of φ with the step in the plane.
  const double k_u = b_uu * s + b_uv * t, k_v = b_uv * s + b_vv * t;
  const double in_u = (c * q_u - b * q_v) * inverse, in_v = (a * q_v - b * q_u) * inverse;
  closest.phi = n.dot(q) - 0.5 * (in_u * k_u + in_v * k_v);
  closest.n = n - k_u * g_u - k_v * g_v;
  closest.turn.col(0) = (h_vv * d.c_u - h_uv * d.c_v) * over;
  closest.turn.col(1) = (h_uu * d.c_v - h_uv * d.c_u) * over;
  // -K (I - φ K)⁻¹ maps v to -b h⁻¹ c·v, by the reciprocal base.
  const Vector3d row_u = b_uu * closest.turn.col(0) + b_uv * closest.turn.col(1),
                 row_v = b_uv * closest.turn.col(0) + b_vv * closest.turn.col(1);
  closest.H.noalias() = -g_u * row_u.transpose();
  closest.H.noalias() -= g_v * row_v.transpose();
  return result;
}

}  // namespace

LayerClosestPoints::LayerClosestPoints(const Surface& surface)
    : surface_(surface), patch_(dynamic_cast<const Patch*>(&surface)) {}

/// False where Newton would do better to be guarded.
bool LayerClosestPoints::follow(const Vector3d& p,
                                Vector2d x,
                                double step,
                                LayerClosestPoint& closest) const {
  constexpr int kMost = 6;
  constexpr double kLongest = 2, kReach = 0.15;  // [mm], and of the domain
  constexpr double kNear = 0.2, kOff = 1e-4;     // [mm]
  const double reach_u = kReach * (patch_->u_max() - patch_->u_min()),
               reach_v = kReach * (patch_->v_max() - patch_->v_min());
  for (int i = 0; i < kMost; ++i) {
    if (!(x[0] >= patch_->u_min() - reach_u && x[0] <= patch_->u_max() + reach_u &&
          x[1] >= patch_->v_min() - reach_v && x[1] <= patch_->v_max() + reach_v))
      return false;
    const ClosestStep newton =
        step_to_closest(patch_->derivatives(x[0], x[1]), p, patch_->data().orientation, closest);
    if (!newton.is_convex || !(newton.length < kLongest)) return false;
    x += newton.step;
    const bool is_off = closest.phi > kOff + 2 * newton.length && newton.length < kNear;
    if (newton.length > step && !is_off) continue;
    if (newton.length > step) closest.phi -= newton.length;
    closest.place = Patch::place(x[0], x[1]);
    closest.at = p;
    closest.known = true;
    return true;
  }
  return false;
}

void LayerClosestPoints::find_by_surface(const Vector3d& p,
                                         const Place& start,
                                         LayerClosestPoint& closest) const {
  closest.place = surface_.closest(p, start);
  const SurfacePoint at = surface_.evaluate(closest.place);
  closest.at = p;
  closest.phi = at.n.dot(p - at.c);
  closest.n = at.n;
  closest.H = -at.K * (Matrix3d::Identity() - closest.phi * at.K).inverse();
  closest.turn.setZero();
  if (patch_ != nullptr) closest.turn = at.dual;
  closest.known = true;
}

void LayerClosestPoints::find(const Vector3d& p,
                              const LayerClosestPoint& from,
                              double step,
                              LayerClosestPoint& closest) const {
  const Place start = from.place;
  if (patch_ != nullptr) {
    const Vector2d x = start.numbers.head<2>() + from.turn.transpose() * (p - from.at);
    if (follow(p, x, step, closest)) return;
  }
  find_by_surface(p, start, closest);
}

void LayerClosestPoints::find_anew(const Vector3d& p, LayerClosestPoint& closest) const {
  find_by_surface(p, surface_.seed(p), closest);
}

}  // namespace condyle
