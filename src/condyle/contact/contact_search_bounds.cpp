/// The bounds by which a search passes over most of its samples.

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/contact/contact_search.h"
#include "condyle/contact/curvature_tensor.h"
#include "condyle/math/simd.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = 40;  // radius of a cluster that is worth a look [sample spacings]
// Points of the other surface that are looked at for a closest point, about, by the time that it takes:
constexpr long kFromNearby = 4;     // by steps from one nearby
constexpr long kFromAnywhere = 30;  // from a seed
constexpr double kDoubt = 0.05;     // of the curvatures: a paraboloid is that of a sample nearby
constexpr double kSteep = 0.7;      // cosine between two normals below which quadrics say nothing
constexpr double kWay = 1.05;       // a distance changes by no more than the way, a chord of it
constexpr double kLeastRoom = 0.5;  // of 1 - gap × curvature, where closest points are unique
constexpr double kCell = 1.5;    // how far beside a sample its quadric is used [radii of its cell]
constexpr double kBeside = 0.3;  // of a radius: how far from its origin a quadric serves as well
constexpr double kToEdge =
    4.0 / 3;                    // of the way beside a sample: that to the closest point at most
constexpr double kClose = 0.2;  // from a closest point, where its quadric is used [spacings]

/// Signed distance of the point from the quadric.
double gap_over(const Facing& facing) {
  return facing.along - 0.5 * facing.beside.dot(facing.at->K * facing.beside);
}

/// A deepest point of s u + ½ q u² within |u| <= r, as a drop >= 0 (s >= 0).
double drop_along(double s, double q, double r) {
  return q > 0 && s < q * r ? s * s / (2 * q) : s * r - 0.5 * q * r * r;
}

/// By how much the gap may be lower than over the quadric at the point, where a surface with the
/// normal n and the tensor K (in a frame turned by R), within r [mm] of the point, rises over its
/// own quadric by ½ `bend` u²; infinite where the surfaces are too steep for that. With u in the
/// tangent plane of that surface the gap changes by s·u + ½ uᵀ Q u; a direction in which it opens
/// may be left to its own minimum.
CONDYLE_FMA_CLONE
double drop_within(const Facing& facing,
                   const Eigen::Vector3d& n,
                   const Eigen::Matrix3d& K,
                   const Eigen::Matrix3d& R,
                   double r,
                   double bend) {
  const SurfacePoint& at = *facing.at;
  const Eigen::Vector3d up = at.n - at.K * facing.beside;
  const double opposite = -up.dot(n);
  if (opposite < kSteep) return kInfinity;
  const Eigen::Vector3d slope = off_normal(up, n);
  // The other surface departs from its quadric by ½ a (t + r)² at most; ½ a r² counts as curvature.
  const double a = facing.bend, size = slope.norm();
  const double s = size + a * facing.beside.norm();
  const Eigen::Vector3d e1 = size > 0 ? Eigen::Vector3d(slope / size) : n.unitOrthogonal();
  const Eigen::Vector3d e2 = n.cross(e1);
  const Eigen::Vector3d own1 = R.transpose() * e1, own2 = R.transpose() * e2;
  const Eigen::Vector3d K1 = opposite * (K * own1), B1 = at.K * e1;
  const double q11 = -K1.dot(own1) - B1.dot(e1) - bend - a, q12 = -K1.dot(own2) - B1.dot(e2);
  const double q22 = -opposite * own2.dot(K * own2) - e2.dot(at.K * e2) - bend - a;
  const double half = 0.5 * (q11 - q22);
  const double least = 0.5 * (q11 + q22) - std::sqrt(half * half + q12 * q12);
  const double drop = drop_along(s, least, r);
  if (q22 <= 0 || a > 0) return drop;
  return std::min(drop, drop_along(s, q11 - q12 * q12 / q22, r));
}

}  // namespace

double bound_of_cell(const Facing& facing,
                     const SurfacePoint& own,
                     const Eigen::Matrix3d& R,
                     double r,
                     double bend,
                     double cutoff) {
  const double gap = gap_over(facing), by_way = gap - facing.error - kWay * r;
  if (by_way > std::min(cutoff, 0.0)) return by_way;
  const double drop = drop_within(facing, R * own.n, own.K, R, r, bend);
  return std::max(by_way, gap - drop);
}

/// Is the innermost shell about a contact not free, as the cells of the nearest samples alone tell?
bool ContactSearch::turns_beside(const KnownContact& contact, const NearContact& near) const {
  if (cover_->on_B.bends_evenly() || cover_->on_A.bends_evenly()) return false;
  if (near.on_B < 0 || near.on_A < 0) return true;
  const auto greatest = [](const SurfaceCover& cover, int sample) {
    return largest_principal(cover.sample(sample).K) + cover.cell_change(sample);
  };
  const double change =
      cover_->on_B.cell_change(near.on_B) + cover_->on_A.cell_change(near.on_A) + near.shift;
  return change > contact.least_curvature &&
         greatest(cover_->on_B, near.on_B) + greatest(cover_->on_A, near.on_A) + near.shift >
             -near.doubt;
}

void ContactSearch::set_known(const std::vector<KnownContact>& known) {
  known_ = known.size();
  if (near_contacts_.size() < known_) near_contacts_.resize(known_);
  for (std::size_t k = 0; k < known_; ++k) {
    const KnownContact& contact = known[k];
    NearContact& near = near_contacts_[k];
    int on_B = near.on_B, on_A = near.on_A;
    near.on_B = nearest_B_.find(contact.on_B, on_B, looked_at_);
    near.on_A = nearest_A_.find(contact.on_A, on_A, looked_at_);
    near.doubt = kDoubt * (contact.K_B.norm() + contact.K_A.norm());
    near.shift =
        bending_B_.shift(near.on_B, contact.K_B) + bending_A_.shift(near.on_A, contact.K_A);
  }
}

/// In a shell about a contact the surfaces are apart where its relative curvature outweighs what
/// both rise over their quadrics, or where a paraboloid of revolution between them has both on its
/// own sides.
bool ContactSearch::is_free(int level, const KnownContact& contact, const NearContact& near) {
  const Rise B = bending_B_.in_shell(level, near.on_B, contact.K_B);
  const Rise A = bending_A_.in_shell(level, near.on_A, contact.K_A);
  return B.over_quadric + A.over_quadric + near.shift < contact.least_curvature ||
         B.over_plane + A.over_plane + near.shift < -near.doubt;
}

/// A ball about a known contact holds all of the sampled surface, and all its shells are free.
bool ContactSearch::touches_only(const KnownContact& contact, const NearContact& near) {
  const SurfaceCover::Cluster& all = sampled().cluster(0);
  const Eigen::Vector3d& center = sampled_on_A_ ? contact.on_A : contact.on_B;
  const double needed = all.radius + (all.center - center).norm();
  const auto outermost = std::upper_bound(shells_.begin(), shells_.end(), needed);
  if (outermost == shells_.end() || turns_beside(contact, near)) return false;
  const int levels = static_cast<int>(outermost - shells_.begin()) + 1;
  const bool B_pays = bending_B_.pays(near.on_B), A_pays = bending_A_.pays(near.on_A);
  if (!B_pays || !A_pays) return false;
  int level = 0;
  while (level < levels && is_free(level, contact, near)) ++level;
  return level == levels;
}

void ContactSearch::set_discs(const std::vector<KnownContact>& known) {
  discs_.clear();
  for (std::size_t k = 0; k < known.size(); ++k) {
    const KnownContact& contact = known[k];
    const NearContact& near = near_contacts_[k];
    if (turns_beside(contact, near)) continue;
    int level = 0;
    while (level < Bending::kLevels && is_free(level, contact, near)) ++level;
    if (level == 0) continue;
    discs_.push_back({sampled_on_A_ ? contact.on_A : contact.on_B,
                      shells_[static_cast<std::size_t>(level - 1)]});
  }
}

/// Tangent steps from the place that is known, or else from a seed, until the point closest to p is
/// within `close` [mm]. What is no nearer than a sample may be a stationary point, but is not the closest one.
void ContactSearch::find_closest(const Eigen::Vector3d& p, double close, Closest& closest) {
  const Surface& surface = other().surface();
  looked_at_ += kFromNearby;
  if (other().bends_evenly()) {
    closest.place = surface.closest(p, closest.place);
    closest.at = surface.evaluate(closest.place);
    closest.known = closest.close = true;
    return;
  }
  const double to_sample =
      closest.near >= 0 ? (p - other().sample(closest.near).c).norm() + close : kInfinity;
  double slide = kInfinity;
  for (int attempt = closest.known ? 0 : 1; attempt < 2 && slide > close; ++attempt) {
    if (attempt == 1) {
      closest.place = closest.near >= 0 ? other().place(closest.near) : surface.seed(p);
      closest.at = surface.evaluate(closest.place);
    }
    for (int step = 0; step < 5 && slide > close; ++step) {
      const Eigen::Vector3d beside = off_normal(p - closest.at.c, closest.at.n);
      closest.place = surface.moved(closest.place, closest.at, beside);
      closest.at = surface.evaluate(closest.place);
      slide = off_normal(p - closest.at.c, closest.at.n).norm();
    }
    if ((p - closest.at.c).norm() > to_sample) slide = kInfinity;
  }
  closest.known = true;
  closest.close = slide <= close;
  if (closest.close) return;
  looked_at_ += kFromAnywhere;
  closest.place = surface.closest(p, surface.seed(p));
  closest.at = surface.evaluate(closest.place);
}

/// Where a surface bends evenly, a quadric of an earlier pose serves as well, not far beside, and on this side of
/// the centre.
bool ContactSearch::is_beside(const Eigen::Vector3d& p, double r, const Closest& closest) const {
  if (!closest.close || !other().bends_evenly()) return false;
  const double reach = kBeside * r;
  const Facing facing = over_quadric(closest.at, p);
  return facing.beside.squaredNorm() < reach * reach && facing.along * closest.at.K.trace() < 1;
}

/// Point p over the quadric at its closest point.
Facing ContactSearch::face_closest(const Eigen::Vector3d& p, double r, Closest& closest) {
  if (!is_beside(p, r, closest)) find_closest(p, kClose * spacing_, closest);
  Facing facing = over_quadric(closest.at, p);
  facing.bend = kInfinity;
  // Where no tangent steps lead to it, all that is known is the distance.
  if (!closest.close) {
    facing.along = std::copysign((p - closest.at.c).norm(), facing.along);
    facing.beside.setZero();
    return facing;
  }
  if (other().bends_evenly())
    facing.bend = even_rise(facing.beside.norm() + r, closest.at.K).over_quadric;
  else if (closest.near >= 0)
    facing.bend = other().cell_change(closest.near);
  return facing;
}

/// Does p face what is known of the other surface? Where its closest point is no better known than it
/// is near the edge, it is found to the last digit: what it stands for must not depend on the pose before.
bool ContactSearch::faces_known_part(const Eigen::Vector3d& p,
                                     double r,
                                     Closest& closest,
                                     Facing& facing) {
  constexpr double kSure = 2;  // times the way to the closest point
  const Surface& surface = other().surface();
  const double edge = surface.edge_distance(closest.place);
  if (!closest.close || std::abs(edge) > kSure * facing.beside.norm()) return edge >= 0;
  looked_at_ += kFromAnywhere;
  closest.place = surface.closest(p, closest.place);
  closest.at = surface.evaluate(closest.place);
  facing = face_closest(p, r, closest);
  return surface.edge_distance(closest.place) >= 0;
}

/// By the quadric of the sample nearest to its centre p: as far as its cell, and by the way beyond.
bool ContactSearch::is_clear_of_sample(const SurfaceCover::Cluster& cluster,
                                       const Eigen::Vector3d& p,
                                       double cutoff,
                                       int near) const {
  const Facing facing = facing_cell(other(), p, near);
  const double cell = other().cell_radius(near), way = kWay * cluster.radius;
  const double beside = facing.beside.squaredNorm();
  const double far = cutoff + way + cell + kBeyondEdge * spacing_;
  if (facing.along > 0 && beside + facing.along * facing.along > far * far) return true;
  if (beside > kCell * kCell * cell * cell) return false;
  const double gap = gap_over(facing);
  return gap - facing.error - way > cutoff || gap + facing.error + way < -deepest_;
}

/// By the quadric at the point of the other surface closest to its centre p.
bool ContactSearch::is_clear_of_closest(const SurfaceCell& cluster,
                                        const RigidTransform& X_from_to,
                                        double cutoff,
                                        Closest& closest) {
  const Eigen::Vector3d p = X_from_to * cluster.at.c;
  const double r = cluster.radius, way = kWay * r;
  const Facing facing = face_closest(p, r, closest);
  const double gap = gap_over(facing);
  if (gap - way > cutoff || gap + way < -deepest_) return true;
  // Beyond an edge they face nothing.
  const double room = 1 - std::abs(gap) * closest.at.K.norm();
  const double edge = other().surface().edge_distance(closest.place);
  if (edge < -way / std::max(room, kLeastRoom) - kBeyondEdge * spacing_) return true;
  if (!closest.close) return false;
  const SurfacePoint& center = cluster.at;
  const double drop = drop_within(facing, X_from_to.R * center.n, center.K, X_from_to.R, r, 0);
  return gap - kWay * cluster.rise - drop > cutoff;
}

/// Is the whole cluster shown to stay above the cutoff, by the way to its centre or by quadrics?
bool ContactSearch::is_clear(int index, const RigidTransform& X_from_to, double cutoff) {
  const SurfaceCover::Cluster& cluster = sampled().cluster(index);
  Closest& closest = cluster_closest_[static_cast<std::size_t>(index)];
  if (!other().bends_evenly()) {
    const Eigen::Vector3d p = X_from_to * cluster.center;
    if (closest.from < 0 && cluster.parent >= 0)
      closest.from = cluster_closest_[static_cast<std::size_t>(cluster.parent)].from;
    closest.near = nearest_of_other().find(p, closest.from, looked_at_);
    if (closest.near >= 0) return is_clear_of_sample(cluster, p, cutoff, closest.near);
  }
  return is_clear_of_closest(bending_sampled().quadrics().of(index).cell, X_from_to, cutoff,
                             closest);
}

bool ContactSearch::in_disc(const SurfaceCover::Cluster& cluster) const {
  return std::any_of(discs_.begin(), discs_.end(), [&](const Disc& disc) {
    const double room = disc.radius - cluster.radius;
    return room > 0 && (cluster.center - disc.center).squaredNorm() < room * room;
  });
}

/// A sample whose cell may reach the cutoff is near.
void ContactSearch::look_at(int sample, int& near, const RigidTransform& X_from_to, double cutoff) {
  estimate(sample, near, X_from_to, cutoff);
  const Seen& now = seen(sample);
  if (now.stamp == now_ && now.lower < cutoff && now.gap > -deepest_) near_.push_back(sample);
}

/// True where the cluster's own bound shows it to be clear. One that was not goes straight to its
/// children until both of them are.
bool ContactSearch::visit(int index, const RigidTransform& X_from_to, double cutoff) {
  const SurfaceCover::Cluster& cluster = sampled().cluster(index);
  if (in_disc(cluster)) return true;
  ++looked_at_;
  char& split = split_[static_cast<std::size_t>(index)];
  if (!split && cluster.radius < kLargest * spacing_ && is_clear(index, X_from_to, cutoff))
    return true;
  if (cluster.child[0] < 0) {
    int near = cluster_closest_[static_cast<std::size_t>(index)].from;
    for (int k = cluster.first; k < cluster.last; ++k)
      look_at(sampled().in_order(k), near, X_from_to, cutoff);
    return false;
  }
  const bool first = visit(cluster.child[0], X_from_to, cutoff);
  const bool second = visit(cluster.child[1], X_from_to, cutoff);
  split = first && second ? 0 : 1;
  return false;
}

/// The gap at a sample, and how low it may be in its cell, by the quadric of the nearest sample of
/// the other surface: that near `near`, which is then its own.
CONDYLE_FMA_CLONE
void ContactSearch::estimate(int sample,
                             int& near,
                             const RigidTransform& X_from_to,
                             double cutoff) {
  ++looked_at_;
  const SurfacePoint& own = sampled().sample(sample);
  const Eigen::Vector3d p = X_from_to * own.c;
  const double r = sampled().cell_radius(sample);
  Closest& there = closest(sample);
  Facing facing;
  if (!other().bends_evenly() && other().size() > 0) {
    there.from = other().nearer(p, near, there.from);
    there.near = nearest_of_other().find(p, there.from, looked_at_);
    near = there.from;
    if (there.near < 0) return;  // beyond the edge of the other surface
    facing = facing_cell(other(), p, there.near);
    const double cell = kCell * other().cell_radius(there.near);
    const double beside = facing.beside.squaredNorm();
    if (beside > cell * cell) {
      const double far =
          cutoff + kWay * r + other().cell_radius(there.near) + kBeyondEdge * spacing_;
      if (facing.along > 0 && beside + facing.along * facing.along > far * far) return;
      facing.at = nullptr;
    }
  }
  Seen& now = seen(sample);
  now.measured = !facing.at;
  now.stamp = now_;
  if (now.measured) facing = face_closest(p, r, there);
  now.faces = now.measured ? faces_known_part(p, r, there, facing)
                           : other().edge_distance(there.near) > kToEdge * facing.beside.norm();
  now.gap = gap_over(facing);
  now.error = facing.error;
  now.lower = bound_of_cell(facing, own, X_from_to.R, r, sampled().cell_change(sample), cutoff);
}

/// To its closest point.
void ContactSearch::measure(int sample, const RigidTransform& X_from_to) {
  Seen& now = seen(sample);
  if (now.measured) return;
  Closest& there = closest(sample);
  const Eigen::Vector3d p = X_from_to * sampled().sample(sample).c;
  Facing facing = face_closest(p, 0, there);
  now.faces = faces_known_part(p, 0, there, facing);
  now.gap = gap_over(facing);
  now.error = 0;
  now.measured = true;
}

}  // namespace condyle
