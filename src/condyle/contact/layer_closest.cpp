#include "condyle/contact/layer_closest.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "condyle/math/simd.h"
#include "condyle/math/simd_sqrt.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLongest = 5;  // step that is followed [mm]

// Points of surfaces that are looked at in the same time, about:
constexpr long kOfFour = 8;      // of four that are followed
constexpr long kBySurface = 20;  // of one that a surface finds, mostly by iteration
constexpr long kExactly = 3;     // of one on a plane, a sphere or a cylinder

/// Places that are followed, and what the last step to each says: not 0 where it is well, the squared
/// distance being convex enough for Newton and the step short.
struct alignas(32) FollowedPlaces {
  double u[4], v[4];
  long well[4];
};

inline __attribute__((always_inline)) Four dot(const Four* a, const Four* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline __attribute__((always_inline)) void load(const FourPoints& from, Four* x) {
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) x[i] = load_four(from[i]);
}

/// Moves four places by a step each; what the closest points are where these end. True where all
/// are well and no step is longer than `longest`.
CONDYLE_FMA_CLONE
bool step_to_closest(const FourDerivatives& at,
                     const FourPoints& p,
                     double orientation,
                     double longest,
                     FollowedPlaces& places,
                     FourClosestPoints& closest) {
  Four q[3], c_u[3], c_v[3], c_uu[3], c_uv[3], c_vv[3];
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) q[i] = load_four(p[i]) - load_four(at.d[0][i]);
  load(at.d[1], c_u);
  load(at.d[2], c_v);
  load(at.d[3], c_uu);
  load(at.d[4], c_uv);
  load(at.d[5], c_vv);
  const Four a = dot(c_u, c_u), b = dot(c_u, c_v), c = dot(c_v, c_v);
  Four square = a * c - b * b;
  square = square > 1e-300 ? square : Four{1e-300, 1e-300, 1e-300, 1e-300};
  const Four inverse = 1 / square, unit = orientation * sqrt_four(inverse);
  const Four n[3] = {(c_u[1] * c_v[2] - c_u[2] * c_v[1]) * unit,
                     (c_u[2] * c_v[0] - c_u[0] * c_v[2]) * unit,
                     (c_u[0] * c_v[1] - c_u[1] * c_v[0]) * unit};
  // Of the squared distance: gradient -q·c_a, second derivatives h; the second form is n·c_ab.
  const Four q_u = dot(q, c_u), q_v = dot(q, c_v);
  const Four h_uu = a - dot(q, c_uu), h_uv = b - dot(q, c_uv), h_vv = c - dot(q, c_vv);
  const Four b_uu = dot(n, c_uu), b_uv = dot(n, c_uv), b_vv = dot(n, c_vv);
  const Four det = h_uu * h_vv - h_uv * h_uv, over = 1 / det;
  const Four s = (h_vv * q_u - h_uv * q_v) * over, t = (h_uu * q_v - h_uv * q_u) * over;
  const Four length = sqrt_four(a * s * s + c * t * t);
  store_four(places.u, load_four(places.u) + s);
  store_four(places.v, load_four(places.v) + t);
  store_four(closest.step, length);
  const auto well = (h_uu > 0.05 * a) & (det > 0.0025 * a * c) & (length < kLongest),
             ends = well & (length <= longest);
  std::memcpy(places.well, &well, sizeof well);
  // Shares of the step by the second form: of the turn of n, and of φ with the step in the plane.
  const Four k_u = b_uu * s + b_uv * t, k_v = b_uv * s + b_vv * t;
  const Four in_u = (c * q_u - b * q_v) * inverse, in_v = (a * q_v - b * q_u) * inverse;
  store_four(closest.phi, dot(n, q) - 0.5 * (in_u * k_u + in_v * k_v));
  // -K (I - φ K)⁻¹ maps v to -b h⁻¹ c·v, by the reciprocal base.
  Four g_u[3], g_v[3], row_u[3], row_v[3];
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    g_u[i] = (c * c_u[i] - b * c_v[i]) * inverse;
    g_v[i] = (a * c_v[i] - b * c_u[i]) * inverse;
    store_four(closest.n[i], n[i] - k_u * g_u[i] - k_v * g_v[i]);
    const Four turn_u = (h_vv * c_u[i] - h_uv * c_v[i]) * over,
               turn_v = (h_uu * c_v[i] - h_uv * c_u[i]) * over;
    store_four(closest.turn[0][i], turn_u);
    store_four(closest.turn[1][i], turn_v);
    row_u[i] = b_uu * turn_u + b_uv * turn_v;
    row_v[i] = b_uv * turn_u + b_vv * turn_v;
  }
  CONDYLE_UNROLL
  for (int i = 0, ij = 0; i < 3; ++i) CONDYLE_UNROLL
  for (int j = i; j < 3; ++j, ++ij)
    store_four(closest.H[ij], -g_u[i] * row_u[j] - g_v[i] * row_v[j]);
  return (ends[0] & ends[1] & ends[2] & ends[3]) != 0;
}

/// u and v where the closest points of p should be.
CONDYLE_FMA_CLONE
void predict(const FourPoints& p, const FourClosestPoints& from, double* u, double* v) {
  Four way[3], turn[3];
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) way[i] = load_four(p[i]) - load_four(from.at[i]);
  load(from.turn[0], turn);
  store_four(u, load_four(from.place[0]) + dot(turn, way));
  load(from.turn[1], turn);
  store_four(v, load_four(from.place[1]) + dot(turn, way));
}

Vector3d one_of(const FourPoints& p, int k) { return {p[0][k], p[1][k], p[2][k]}; }

}  // namespace

FourClosestPoints FourClosestPoints::repeated(int k) const {
  FourClosestPoints all;
  const auto repeat = [k](const double* from, double* to) { std::fill(to, to + 4, from[k]); };
  for (int i = 0; i < 3; ++i) {
    repeat(at[i], all.at[i]);
    repeat(n[i], all.n[i]);
    repeat(place[i], all.place[i]);
    for (int j = 0; j < 2; ++j) repeat(turn[j][i], all.turn[j][i]);
  }
  for (int i = 0; i < 6; ++i) repeat(H[i], all.H[i]);
  repeat(phi, all.phi);
  repeat(step, all.step);
  return all;
}

LayerClosestPoints::LayerClosestPoints(const Surface& surface)
    : surface_(surface), patch_(dynamic_cast<const Patch*>(&surface)) {
  if (patch_ == nullptr) return;
  constexpr double kReach = 0.15;  // of the domain
  cells_.emplace(*patch_);
  bends_.emplace(*cells_);
  const double reach_u = kReach * (patch_->u_max() - patch_->u_min()),
               reach_v = kReach * (patch_->v_max() - patch_->v_min());
  u_[0] = patch_->u_min() - reach_u, u_[1] = patch_->u_max() + reach_u;
  v_[0] = patch_->v_min() - reach_v, v_[1] = patch_->v_max() + reach_v;
}

/// Those are not found where Newton would do better to be guarded.
unsigned LayerClosestPoints::follow(const FourPoints& p,
                                    const FourClosestPoints& from,
                                    double step,
                                    FourClosestPoints& closest) const {
  constexpr int kMost = 6;
  constexpr double kNear = 0.2, kOff = 1e-4;  // [mm]
  constexpr unsigned kAll = 15;
  FollowedPlaces places;
  predict(p, from, places.u, places.v);
  double *u = places.u, *v = places.v;
  unsigned lost = 0, found = 0;
  FourDerivatives at;
  for (int i = 0; i < kMost && (found | lost) != kAll; ++i) {
    for (int k = 0; k < 4; ++k) {
      if ((u[k] >= u_[0]) & (u[k] <= u_[1]) & (v[k] >= v_[0]) & (v[k] <= v_[1])) continue;
      lost |= 1U << k;
      u[k] = patch_->u_min(), v[k] = patch_->v_min();
    }
    cells_->derivatives(u, v, at);
    found = 0;
    if (step_to_closest(at, p, patch_->data().orientation, step, places, closest)) found = kAll;
    for (int k = 0; k < 4 && found != kAll; ++k) {
      if (places.well[k] == 0) lost |= 1U << k;
      const double length = closest.step[k];
      if (!(length <= step)) {
        if (!(closest.phi[k] > kOff + 2 * length && length < kNear)) continue;
        closest.phi[k] -= length;
      }
      found |= 1U << k;
    }
  }
  std::memcpy(closest.place[0], u, sizeof closest.place[0]);
  std::memcpy(closest.place[1], v, sizeof closest.place[1]);
  std::fill(closest.place[2], closest.place[2] + 4, 0);
  return kAll & ~(found & ~lost);
}

long LayerClosestPoints::one_by_surface() const {
  return surface_.bends_evenly() ? kExactly : kBySurface;
}

void LayerClosestPoints::find_by_surface(const FourPoints& p,
                                         int k,
                                         const Place& start,
                                         FourClosestPoints& closest) const {
  const Vector3d x = one_of(p, k);
  const Place place = surface_.closest(x, start);
  const SurfacePoint at = surface_.evaluate(place);
  const double phi = at.n.dot(x - at.c);
  const Matrix3d H = -at.K * (Matrix3d::Identity() - phi * at.K).inverse();
  closest.phi[k] = phi;
  closest.step[k] = 0;
  for (int i = 0, ij = 0; i < 3; ++i) {
    closest.at[i][k] = x[i];
    closest.place[i][k] = place.numbers[i];
    closest.n[i][k] = at.n[i];
    for (int j = 0; j < 2; ++j) closest.turn[j][i][k] = patch_ != nullptr ? at.dual(i, j) : 0;
    for (int j = i; j < 3; ++j) closest.H[ij++][k] = 0.5 * (H(i, j) + H(j, i));
  }
}

long LayerClosestPoints::find(const FourPoints& p,
                              const FourClosestPoints& from,
                              double step,
                              FourClosestPoints& closest,
                              unsigned asked) const {
  FourPoints starts;
  std::memcpy(starts, from.place, sizeof starts);
  unsigned lost = asked;
  long looked_at = 0;
  if (finds_in_fours()) {
    looked_at = kOfFour;
    lost = follow(p, from, step, closest);
    std::memcpy(closest.at, p, sizeof closest.at);
  }
  for (int k = 0; k < 4 && lost != 0; ++k)
    if ((lost >> k & 1U) != 0) find_by_surface(p, k, {one_of(starts, k)}, closest);
  return looked_at + one_by_surface() * std::popcount(lost);
}

long LayerClosestPoints::find_anew(const FourPoints& p, FourClosestPoints& closest) const {
  for (int k = 0; k < 4; ++k) find_by_surface(p, k, surface_.seed(one_of(p, k)), closest);
  return 2 * 4 * one_by_surface();
}

}  // namespace condyle
