#include "condyle/contact/layer_side.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/math/simd.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Cosine between the normals of two places that face each other, at most: others have passed
/// behind the other body.
constexpr double kOpposed = -0.3;

/// Points that have moved by less than this since their closest points were found are told from
/// there: φ and n by their derivatives, with errors of this cubed and squared, over radii of
/// curvature [mm].
constexpr double kStill = 1e-5;

/// Longest last step to a closest point that is known from before: its curvatures are wrong by this
/// over radii of curvature [mm].
constexpr double kFollowed = 3e-6;

/// Longest last step to any [mm].
constexpr double kFound = 1e-7;

}  // namespace

LayerSide::LayerSide(const LayerLattice& points, bool of_A, const Surface& into)
    : points_(points),
      of_A_(of_A),
      into_(into),
      find_(into),
      blocks_(points.blocks.size()),
      closest_(points.x.size()),
      block_bounds_(points.blocks.size()),
      bounds_(points.x.size()),
      is_pressed_(points.x.size(), 0) {
  pressed_.reserve(points.x.size());
}

void LayerSide::reset() {
  std::fill(blocks_.begin(), blocks_.end(), LayerClosestPoint());
  std::fill(closest_.begin(), closest_.end(), LayerClosestPoint());
  std::fill(block_bounds_.begin(), block_bounds_.end(), PhiBound());
  std::fill(bounds_.begin(), bounds_.end(), PhiBound());
  is_at_ = false;
}

/// May a block hold points that are pressed? It is told from where its closest point was found if
/// that is enough to say.
bool LayerSide::is_near(std::size_t block, const RigidTransform& X) {
  constexpr double kSurely = 0.75;
  LayerClosestPoint& closest = blocks_[block];
  const Vector3d center = X * points_.blocks[block].center;
  const double radius = points_.blocks[block].radius;
  if (block_bounds_[block].is_clear(center, radius)) return false;
  const Vector3d v = center - closest.at;
  if (closest.known &&
      (closest.phi + v.norm() <= radius || closest.phi + closest.n.dot(v) < kSurely * radius))
    return true;
  if (closest.known)
    find_.find(center, closest, kFound, closest);
  else
    find_.find_anew(center, closest);
  block_bounds_[block] = PhiBound(closest);
  return !(closest.phi > radius);
}

void LayerSide::press(std::size_t point, const LayerClosestPoint& block, const RigidTransform& X) {
  const Vector3d p = X * points_.x[point];
  if (bounds_[point].is_clear(p, 0)) return;
  LayerClosestPoint& closest = closest_[point];
  if (!closest.known)
    find_.find(p, block, kFound, closest);
  else if (!((p - closest.at).squaredNorm() < kStill * kStill))
    find_.find(p, closest, kFollowed, closest);
  bounds_[point] = PhiBound(closest);
  const Vector3d v = p - closest.at, Hv = closest.H * v;
  const double phi = closest.phi + closest.n.dot(v) + 0.5 * v.dot(Hv);
  if (!(phi < 0)) return;
  const Vector3d n = closest.n + Hv;
  if (n.dot(X.R * points_.n[point]) < kOpposed) pressed_.push_back({point, phi, p, n});
}

/// Finds the points that are pressed, if it does not know them.
void LayerSide::press_at(const RigidTransform& X_BA) {
  if (is_at_ && X_.R == X_BA.R && X_.p == X_BA.p) return;
  const RigidTransform X = of_A_ ? X_BA : X_BA.inverse();
  pressed_.clear();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!is_near(b, X)) continue;
    const LayerBlock& block = points_.blocks[b];
    for (std::size_t i = block.first; i < block.first + block.count; ++i) press(i, blocks_[b], X);
  }
  X_ = X_BA;
  is_at_ = true;
}

std::size_t LayerSide::pressed(const RigidTransform& X_BA) {
  press_at(X_BA);
  return pressed_.size();
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

/// Sums over points in the frame of the other body, s being the arms of forces f = ±p n.
struct Moments {
  double force = 0;                   ///< Σ w p [N]
  Vector3d f = Vector3d::Zero();      ///< Σ w f [N]
  Matrix3d s_f = Matrix3d::Zero();    ///< Σ w s fᵀ [N mm]
  Matrix3d G = Matrix3d::Zero();      ///< Σ w G [N/mm]
  Matrix3d S_G = Matrix3d::Zero();    ///< Σ w [s]x G [N]
  Matrix3d S_G_S = Matrix3d::Zero();  ///< Σ w [s]x G [s]x [N mm]
};

CONDYLE_FMA_CLONE
void add_point(
    const Vector3d& s, const Vector3d& n, const Matrix3d& H, double wp, double wk, Moments& sums) {
  double G[3][3], SG[3][3];
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) G[j][i] = wp * H(i, j) - wk * n[i] * n[j];
  for (int j = 0; j < 3; ++j) {
    SG[j][0] = s[1] * G[j][2] - s[2] * G[j][1];
    SG[j][1] = s[2] * G[j][0] - s[0] * G[j][2];
    SG[j][2] = s[0] * G[j][1] - s[1] * G[j][0];
  }
  sums.force += wp;
  for (int j = 0; j < 3; ++j) {
    sums.f[j] += wp * n[j];
    for (int i = 0; i < 3; ++i) {
      sums.s_f(i, j) += s[i] * (wp * n[j]);
      sums.G(i, j) += G[j][i];
      sums.S_G(i, j) += SG[j][i];
    }
  }
  for (int i = 0; i < 3; ++i) {  // the rows of [s]x G times [s]x
    sums.S_G_S(i, 0) += SG[1][i] * s[2] - SG[2][i] * s[1];
    sums.S_G_S(i, 1) += SG[2][i] * s[0] - SG[0][i] * s[2];
    sums.S_G_S(i, 2) += SG[0][i] * s[1] - SG[1][i] * s[0];
  }
}

Vector3d axis_of(const Matrix3d& s_f) {
  return {s_f(1, 2) - s_f(2, 1), s_f(2, 0) - s_f(0, 2), s_f(0, 1) - s_f(1, 0)};
}

/// Points fixed on A, all in the frame of B.
void add_to_wrench_of_A(const Moments& sums, Wrench& wrench) {
  wrench.f += sums.f;
  wrench.m += axis_of(sums.s_f);
  wrench.F1 += sums.G;
  wrench.F2 += sums.S_G.transpose();  // -G S, G being symmetric
  wrench.M1 += sums.S_G;
  wrench.M2 += sums.s_f - sums.s_f.trace() * Matrix3d::Identity() - sums.S_G_S;
}

/// Points fixed on B, all in the frame of A, n out of A: f = -p n.
void add_to_wrench_of_B(const Moments& sums, const Matrix3d& R, Wrench& wrench) {
  const Vector3d f = -(R * sums.f);
  const Matrix3d s_f = -(R * sums.s_f * R.transpose()), G = R * sums.G * R.transpose(),
                 S_G = R * sums.S_G * R.transpose(), S_G_S = R * sums.S_G_S * R.transpose(),
                 f_x = skew(f);
  wrench.f += f;
  wrench.m += axis_of(s_f);
  wrench.F1 += G;
  wrench.F2 += S_G.transpose() - f_x;
  wrench.M1 += S_G + f_x;
  wrench.M2 -= S_G_S + s_f.transpose() - s_f.trace() * Matrix3d::Identity();
}

}  // namespace

double LayerSide::add_to(const RigidTransform& X_BA,
                         const LayerLaw& law,
                         double share,
                         Wrench& wrench) {
  press_at(X_BA);
  Moments sums;
  for (const Pressed& pressed : pressed_) {
    const LayerLaw::Answer answer = law.at(-pressed.phi);
    const double w = share * points_.area[pressed.point];
    const Vector3d s = of_A_ ? Vector3d(pressed.p - X_BA.p) : pressed.p;
    add_point(s, pressed.n, closest_[pressed.point].H, w * answer.pressure, w * answer.stiffness,
              sums);
  }
  if (of_A_)
    add_to_wrench_of_A(sums, wrench);
  else
    add_to_wrench_of_B(sums, X_BA.R, wrench);
  return sums.force;
}

void LayerSide::add_to(const RigidTransform& X_BA,
                       const LayerLaw& law,
                       double share,
                       LayerSums& sums) {
  press_at(X_BA);
  for (const Pressed& pressed : pressed_) {
    const Vector3d& own = points_.x[pressed.point];
    const Vector3d out_of_B = of_A_ ? pressed.n : Vector3d(-(X_BA.R * pressed.n));
    const double w = share * points_.area[pressed.point];
    const double faded = points_.faded.empty() ? 0 : share * points_.faded[pressed.point];
    add_to_sums({law.at(-pressed.phi), w, faded, -pressed.phi, of_A_ ? pressed.p : own, out_of_B,
                 into_.edge_distance(closest_[pressed.point].place) < 0},
                sums);
  }
}

// With the arm s of the point and n out of B: dp = -W'' n.(da + dπ x s), whichever body carries the
// point; one of A moves by da + dπ x s, one of B stays.
void LayerSide::add_to(const RigidTransform& X_BA,
                       const LayerLaw& law,
                       double share,
                       LayerRateSums& sums) {
  press_at(X_BA);
  for (const Pressed& pressed : pressed_) {
    const double depth = -pressed.phi, w = share * points_.area[pressed.point];
    const LayerLaw::Answer answer = law.at(depth);
    const Vector3d n = of_A_ ? pressed.n : Vector3d(-(X_BA.R * pressed.n));
    const Vector3d x = of_A_ ? pressed.p : points_.x[pressed.point], s = x - X_BA.p;
    Eigen::Matrix<double, 1, 6> rate;
    rate << n.transpose(), s.cross(n).transpose();
    rate *= -w * answer.stiffness;
    sums.force += rate;
    sums.moment += x * rate;
    if (of_A_) {
      const double force = w * answer.pressure;
      sums.moment.leftCols<3>().diagonal().array() += force;
      sums.moment.rightCols<3>() -= force * skew(s);
    }
    const std::array<double, 2> by_moduli = law.pressure_by_moduli(depth);
    for (std::size_t side = 0; side < 2; ++side) {
      const double stiffer = w * by_moduli[side];
      sums.stiffer[side].force += stiffer;
      sums.stiffer[side].moment += stiffer * x;
      sums.stiffer[side].f += stiffer * n;
      sums.stiffer[side].m += stiffer * s.cross(n);
    }
  }
}

void LayerSide::add_pressures(const RigidTransform& X_BA,
                              const LayerLaw& law,
                              std::vector<PressurePoint>& points) {
  press_at(X_BA);
  for (const Pressed& pressed : pressed_) {
    const std::size_t i = pressed.point;
    points.push_back({of_A_, points_.place[i], points_.x[i], law.at(-pressed.phi).pressure,
                      -pressed.phi, points_.area[i]});
  }
}

void LayerSide::add_corner(std::size_t corner,
                           const RigidTransform& X,
                           const LayerLaw& law,
                           double share,
                           const LayerCorners& corners,
                           CornerForce& sums) const {
  const Vector3d p = X * corners.lattice.x[corner];
  double phi = 0, count = 0;
  Vector3d n = Vector3d::Zero(), turn = Vector3d::Zero();
  for (const int k : corners.around[corner]) {
    if (k < 0 || is_pressed_[static_cast<std::size_t>(k)] == 0) continue;
    const LayerClosestPoint& closest = closest_[static_cast<std::size_t>(k)];
    const Vector3d v = p - closest.at, Hv = closest.H * v;
    phi += closest.phi + closest.n.dot(v) + 0.5 * v.dot(Hv);
    n += closest.n;
    turn += Hv;
    ++count;
  }
  if (!(phi < 0)) return;
  // Between four points a cubic has the mean of their normals and half of the turns.
  n = (n + (count == 4 ? 0.5 : 1) * turn) / count;
  if (!(n.dot(X.R * corners.lattice.n[corner]) < kOpposed)) return;
  const double force = share * corners.lattice.area[corner] * law.at(-phi / count).pressure;
  sums.force += force;
  sums.on_A += force * n;
}

void LayerSide::add_to(const RigidTransform& X_BA,
                       const LayerLaw& law,
                       double share,
                       const LayerCorners& corners,
                       CornerForce& sums) {
  press_at(X_BA);
  is_done_.resize(corners.lattice.x.size(), 0);
  const RigidTransform X = of_A_ ? X_BA : X_BA.inverse();
  CornerForce own;
  for (const Pressed& pressed : pressed_) is_pressed_[pressed.point] = 1;
  for (const Pressed& pressed : pressed_)
    for (const int corner : corners.of_cell[pressed.point]) {
      if (corner < 0 || is_done_[static_cast<std::size_t>(corner)] != 0) continue;
      is_done_[static_cast<std::size_t>(corner)] = 1;
      add_corner(static_cast<std::size_t>(corner), X, law, share, corners, own);
    }
  for (const Pressed& pressed : pressed_) {
    is_pressed_[pressed.point] = 0;
    for (const int corner : corners.of_cell[pressed.point])
      if (corner >= 0) is_done_[static_cast<std::size_t>(corner)] = 0;
  }
  sums.force += own.force;
  sums.on_A += of_A_ ? own.on_A : Vector3d(-(X_BA.R * own.on_A));
}

}  // namespace condyle
