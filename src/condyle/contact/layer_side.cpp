#include "condyle/contact/layer_side.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Cosine between the normals of two places that face each other, at most: others have passed
/// behind the other body.
constexpr double kOpposed = -0.3;

}  // namespace

/// What a point is pressed against, in the frame of the body that carries the other surface.
struct LayerSide::Pressed {
  std::size_t point;
  double phi;  ///< signed distance [mm], < 0
  Vector3d n;  ///< out of the other solid
  Matrix3d K;  ///< curvature tensor there [1/mm]
  Place place;
};

LayerSide::LayerSide(const LayerLattice& points, bool of_A, const Surface& into)
    : points_(points),
      of_A_(of_A),
      into_(into),
      blocks_(points.blocks.size()),
      seen_(points.x.size()) {}

void LayerSide::reset() {
  std::fill(blocks_.begin(), blocks_.end(), Seen());
  std::fill(seen_.begin(), seen_.end(), Seen());
}

/// May a block hold points that are pressed?
bool LayerSide::is_near(std::size_t block, const RigidTransform& X) {
  Seen& seen = blocks_[block];
  const Vector3d center = X * points_.blocks[block].center;
  const double radius = points_.blocks[block].radius;
  if (seen.is_clear(center, radius)) return false;
  seen.place = into_.closest(center, seen.known ? seen.place : into_.seed(center));
  const SurfacePoint at = into_.evaluate_frame(seen.place);
  seen = {seen.place, center, at.n.dot(center - at.c), true};
  return !(seen.phi > radius);
}

bool LayerSide::press(std::size_t point,
                      const Seen& block,
                      const RigidTransform& X,
                      Pressed& pressed) {
  const Vector3d p = X * points_.x[point];
  Seen& seen = seen_[point];
  if (seen.is_clear(p, 0)) return false;
  const Place place = into_.closest(p, seen.known ? seen.place : block.place);
  const SurfacePoint at = into_.evaluate(place);
  seen = {place, p, at.n.dot(p - at.c), true};
  pressed = {point, seen.phi, at.n, at.K, place};
  return pressed.phi < 0 && at.n.dot(X.R * points_.n[point]) < kOpposed;
}

template <typename Visit>
void LayerSide::visit(const RigidTransform& X_BA, const Visit& visit) {
  const RigidTransform X = of_A_ ? X_BA : X_BA.inverse();
  Pressed pressed;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!is_near(b, X)) continue;
    const LayerBlock& block = points_.blocks[b];
    for (std::size_t i = block.first; i < block.first + block.count; ++i)
      if (press(i, blocks_[b], X, pressed)) visit(pressed);
  }
}

namespace {

/// What a pressed point does.
struct Push {
  LayerLaw::Answer answer;
  double w, faded;  ///< area that it stands for, and that a border took [mm²]
  double depth;     ///< [mm]
  Vector3d x, n;    ///< where, and out of B, ground frame
  bool beyond;      ///< it faces what lies beyond an edge
};

void add_to_sums(const Push& push, LayerSums& sums) {
  const double force = push.w * push.answer.pressure;
  ++sums.points;
  sums.energy += push.w * push.answer.energy;
  sums.area += push.w;
  sums.force += force;
  sums.moment += force * push.x;
  sums.on_A += force * push.n;
  sums.torque += force * push.x.cross(push.n);
  sums.deepest = std::max(sums.deepest, push.depth);
  const double faded = push.faded * push.answer.pressure, beyond = push.beyond ? force : 0;
  sums.faded += faded;
  sums.beyond += beyond;
  sums.lost_moment += (faded + beyond) * push.x;
  if (push.answer.pressure <= sums.peak_pressure) return;
  sums.peak_pressure = push.answer.pressure;
  sums.peak = push.x;
  sums.normal = push.n;
}

/// Force f at the arm s, and G: the blocks of a point that is fixed on A, or on B.
void add_to_wrench(
    const Vector3d& f, const Vector3d& s, const Matrix3d& G, bool of_A, Wrench& wrench) {
  const Matrix3d S = skew(s), f_x = skew(f), SG = S * G;
  wrench.f += f;
  wrench.m += s.cross(f);
  wrench.F1 += G;
  if (of_A) {
    wrench.F2 += SG.transpose();  // -G S, G being symmetric
    wrench.M1 += SG;
    wrench.M2 += f_x * S - SG * S;
  } else {
    wrench.F2 += SG.transpose() - f_x;
    wrench.M1 += SG + f_x;
    wrench.M2 -= SG * S + S * f_x;
  }
}

}  // namespace

void LayerSide::add_to(const RigidTransform& X_BA,
                       const LayerLaw& law,
                       double share,
                       Wrench* wrench,
                       LayerSums& sums) {
  visit(X_BA, [&](const Pressed& pressed) {
    const Vector3d& own = points_.x[pressed.point];
    const Vector3d s = of_A_ ? Vector3d(X_BA.R * own) : Vector3d(own - X_BA.p);
    const double phi = pressed.phi;
    const LayerLaw::Answer answer = law.at(-phi);
    const Vector3d n = of_A_ ? pressed.n : Vector3d(X_BA.R * pressed.n);
    const Vector3d out_of_B = of_A_ ? n : Vector3d(-n);
    const double w = share * points_.area[pressed.point];
    const double faded = points_.faded.empty() ? 0 : share * points_.faded[pressed.point];
    add_to_sums(
        {answer, w, faded, -phi, X_BA.p + s, out_of_B, into_.edge_distance(pressed.place) < 0},
        sums);
    if (wrench == nullptr) return;
    Matrix3d H = -pressed.K * (Matrix3d::Identity() - phi * pressed.K).inverse();
    if (!of_A_) H = X_BA.R * H * X_BA.R.transpose();
    const Matrix3d G = w * (answer.pressure * H - answer.stiffness * n * n.transpose());
    add_to_wrench(w * answer.pressure * out_of_B, s, G, of_A_, *wrench);
  });
}

void LayerSide::add_pressures(const RigidTransform& X_BA,
                              const LayerLaw& law,
                              std::vector<PressurePoint>& points) {
  visit(X_BA, [&](const Pressed& pressed) {
    const std::size_t i = pressed.point;
    points.push_back({of_A_, points_.place[i], points_.x[i], law.at(-pressed.phi).pressure,
                      -pressed.phi, points_.area[i]});
  });
}

}  // namespace condyle
