/// The bounds by which a search passes over most of its samples.

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "equilibrium/contact_search.h"
#include "math/simd.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = 40;  // radius of a cluster that is worth a look [sample spacings]
constexpr double kDoubt = 0.05;  // of the curvatures: a paraboloid is that of a sample nearby
constexpr double kSteep = 0.7;   // cosine between two normals below which quadrics say nothing

/// The greatest principal value off the normal of a curvature tensor: where that of the sum of two
/// is positive, the gap closes sideways.
double largest_principal(double trace, double square) {
  return 0.5 * (trace + std::sqrt(std::max(0.0, 2 * square - trace * trace)));
}

Eigen::Vector3d off_normal(const Eigen::Vector3d& v, const Eigen::Vector3d& n) {
  return v - v.dot(n) * n;
}

}  // namespace

/// About a contact the surfaces are apart as far, shell by shell, as its relative curvature
/// outweighs what both rise over their quadrics, or as a paraboloid of revolution between them has
/// both on its own sides.
void ContactSearch::set_discs(const std::vector<KnownContact>& known) {
  discs_.clear();
  for (const KnownContact& contact : known) {
    near_contact_B_ = bending_B_.nearest(contact.on_B, near_contact_B_);
    near_contact_A_ = bending_A_.nearest(contact.on_A, near_contact_A_);
    const double doubt = kDoubt * (contact.K_B.norm() + contact.K_A.norm());
    double radius = 0;
    for (int level = 0; level < Bending::kLevels; ++level) {
      const Rise B = bending_B_.in_shell(level, near_contact_B_, contact.K_B);
      const Rise A = bending_A_.in_shell(level, near_contact_A_, contact.K_A);
      if (!(B.over_quadric + A.over_quadric < contact.least_curvature) &&
          !(B.over_plane + A.over_plane < -doubt))
        break;
      radius = shells_[static_cast<std::size_t>(level)];
    }
    if (radius > 0) discs_.push_back({sampled_on_A_ ? contact.on_A : contact.on_B, radius});
  }
}

/// Tangent steps from the foot that is known, or else from a seed, until the foot of p is within
/// `close` [mm].
void ContactSearch::find_foot(const Eigen::Vector3d& p, double close, Quadric& quadric) const {
  double slide = kInfinity;
  for (int attempt = quadric.known ? 0 : 1; attempt < 2 && slide > close; ++attempt) {
    if (attempt == 1) {
      quadric.place = other().seed(p);
      quadric.at = other().evaluate(quadric.place);
    }
    for (int step = 0; step < 5 && slide > close; ++step) {
      const Eigen::Vector3d tangential = off_normal(p - quadric.at.c, quadric.at.n);
      quadric.place = other().moved(quadric.place, quadric.at, tangential);
      quadric.at = other().evaluate(quadric.place);
      slide = off_normal(p - quadric.at.c, quadric.at.n).norm();
    }
  }
  quadric.known = true;
  quadric.close = slide <= close;
  if (!quadric.close) {
    quadric.place = other().closest(p, other().seed(p));
    quadric.at = other().evaluate(quadric.place);
  }
  quadric.near = (sampled_on_A_ ? bending_B_ : bending_A_).nearest(quadric.at.c, quadric.near);
}

/// Signed distance of p from the surface by its quadric, or from its closest point.
double ContactSearch::gap_over(const Quadric& quadric, const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = p - quadric.at.c;
  const double along = d.dot(quadric.at.n);
  if (!quadric.close) return std::copysign(d.norm(), along);
  const Eigen::Vector3d tangential = off_normal(d, quadric.at.n);
  return along - 0.5 * tangential.dot(quadric.at.K * tangential);
}

double ContactSearch::gap_of(int sample, const RigidTransform& X_from_to) {
  if (stamp_[sample] == now_) return gap_[sample];
  stamp_[sample] = now_;
  const Eigen::Vector3d p = X_from_to * points_[sample];
  Quadric& foot = feet_[sample];
  find_foot(p, 0.2 * spacing_, foot);
  gap_[sample] = gap_over(foot, p);
  return gap_[sample];
}

/// What the gap by a quadric may be wrong by at a point `t` beside its origin.
double ContactSearch::doubt(const Quadric& quadric, double t) {
  if (!quadric.close) return 0;
  return 0.5 * t * t *
         (sampled_on_A_ ? bending_B_ : bending_A_).within(t, quadric.near, quadric.at.K);
}

/// By how much the gap may be lower somewhere in the cluster than at its centre, which lies
/// `tangential` beside the origin of the other surface's quadric; infinite where the surfaces are
/// too steep for that.
CONDYLE_FMA_CLONE
double ContactSearch::drop_within(const Cluster& cluster,
                                  const Eigen::Vector3d& tangential,
                                  const RigidTransform& X_from_to) {
  const double r = cluster.radius;
  const SurfacePoint& at = cluster.other.at;
  const Eigen::Vector3d n = X_from_to.R * normals_[cluster.center];
  const Eigen::Vector3d up = at.n - at.K * tangential;
  if (-up.dot(n) < kSteep) return kInfinity;
  const Eigen::Matrix3d& K = curvatures_[cluster.center];
  const Eigen::Matrix3d RK = X_from_to.R * K, KR = at.K * X_from_to.R;
  const double trace = K.trace() + at.K.trace();
  const double square = K.squaredNorm() + at.K.squaredNorm() + 2 * RK.cwiseProduct(KR).sum();
  Bending& bending = sampled_on_A_ ? bending_B_ : bending_A_;
  // The other surface departs from its quadric by ½ a (t + r)² at most; ½ a r² counts as curvature.
  const double t = tangential.norm(), a = bending.within(t + r, cluster.other.near, at.K);
  const double beside = 0.5 * a * t * (t + 2 * r);
  const double opening = -largest_principal(trace, square) - cluster.bend - a;
  const double facing = -up.dot(n), tilt = 1 / (facing * facing);
  const double slope = off_normal(up, n).norm();
  if (opening > 0 && slope < opening * r) return tilt * slope * slope / (2 * opening) + beside;
  return tilt * (slope * r - 0.5 * opening * r * r) + beside;
}

/// Is the whole cluster shown to stay above the cutoff, by its quadric or by the way to its centre?
/// First with the quadric of an earlier pose as it is, then with one at the foot of this pose.
CONDYLE_FMA_CLONE
bool ContactSearch::is_clear(Cluster& cluster, const RigidTransform& X_from_to, double cutoff) {
  Quadric& quadric = cluster.other;
  const Eigen::Vector3d p = X_from_to * points_[cluster.center];
  const double reach = 0.5 * std::max(cluster.radius, spacing_);
  for (bool fresh = false;; fresh = true) {
    if (fresh || !quadric.close) find_foot(p, 0.5 * reach, quadric);
    const Eigen::Vector3d tangential = off_normal(p - quadric.at.c, quadric.at.n);
    const double gap = gap_over(quadric, p);
    const bool near_foot = !quadric.close || tangential.squaredNorm() < reach * reach;
    if (near_foot) {
      // A distance changes by no more than the way; far behind an open patch is not inside.
      const double way = 1.05 * cluster.radius + doubt(quadric, tangential.norm());
      if (gap - way > cutoff || gap + way < -deepest_) return true;
      // Feet move less than twice as far as points; beyond an edge they face nothing.
      if (other().edge_distance(quadric.place) < -2 * way - kBeyondEdge * spacing_) return true;
    }
    if (quadric.close && gap - drop_within(cluster, tangential, X_from_to) > cutoff) return true;
    if (near_foot) return false;
  }
}

/// True where the cluster's own bound shows it to be clear. One that was not goes straight to its
/// children until both of them are.
bool ContactSearch::visit(int index, const RigidTransform& X_from_to, double cutoff) {
  Cluster& cluster = clusters_[index];
  const Eigen::Vector3d& center = points_[cluster.center];
  for (const Disc& disc : discs_) {
    const double room = disc.radius - cluster.radius;
    if (room > 0 && (center - disc.center).squaredNorm() < room * room) return true;
  }
  if (!cluster.split && cluster.radius < kLargest * spacing_ &&
      is_clear(cluster, X_from_to, cutoff))
    return true;
  if (cluster.child[0] < 0) {
    scan(cluster, X_from_to, cutoff);
    return false;
  }
  const bool first = visit(cluster.child[0], X_from_to, cutoff);
  const bool second = visit(cluster.child[1], X_from_to, cutoff);
  cluster.split = !(first && second);
  return false;
}

/// The samples of a leaf, but for those that the quadric at its centre shows to be high enough.
void ContactSearch::scan(const Cluster& cluster, const RigidTransform& X_from_to, double cutoff) {
  const SurfacePoint& at = cluster.other.at;
  Bending& bending = sampled_on_A_ ? bending_B_ : bending_A_;
  for (int k = cluster.first; k < cluster.last; ++k) {
    const int sample = order_[k];
    if (cluster.other.close) {
      const Eigen::Vector3d d = X_from_to * points_[sample] - at.c;
      const Eigen::Vector3d t = off_normal(d, at.n);
      const double allowance = bending.within(t.norm(), cluster.other.near, at.K);
      if (d.dot(at.n) - 0.5 * (t.dot(at.K * t) + allowance * t.squaredNorm()) > cutoff) continue;
    }
    const double gap = gap_of(sample, X_from_to);
    if (gap < cutoff && gap > -deepest_) near_.push_back(sample);
  }
}

}  // namespace condyle
