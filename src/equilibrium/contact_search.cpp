#include "equilibrium/contact_search.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "elements/contact.h"
#include "equilibrium/contact_scales.h"
#include "equilibrium/gap_paraboloid.h"
#include "equilibrium/line_contact.h"
#include "math/simd.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLeafSize = 8;
// All in sample spacings:
constexpr double kBeyondEdge = 2;  // how far beyond the known part a minimum may lie
constexpr double kDeepest = 12;    // overlap of a surface with an edge that is still taken for one
constexpr double kLargest = 40;    // radius of a cluster that is worth a look
constexpr double kBendingSpacing = 2;
constexpr double kValley = 0.06;  // a minimum between samples lies lower than both by this at most
constexpr double kSame = 0.3;     // a minimum predicted nearer to one that is known is that one
constexpr double kModel = 0.01;   // what the paraboloid of the gap may be wrong by within its reach
constexpr double kDoubt = 0.05;   // of the curvatures: a paraboloid is that of a sample nearby
constexpr double kSteep = 0.7;    // cosine between two normals below which quadrics say nothing

/// The greatest principal value off the normal of a curvature tensor: where that of the sum of two
/// is positive, the gap closes sideways.
double largest_principal(double trace, double square) {
  return 0.5 * (trace + std::sqrt(std::max(0.0, 2 * square - trace * trace)));
}

Eigen::Vector3d off_normal(const Eigen::Vector3d& v, const Eigen::Vector3d& n) {
  return v - v.dot(n) * n;
}

/// The spacing that is wanted, or a wider one where that would take too many samples: a small model
/// on a large ball. The area is told by a coarse cover.
double affordable_spacing(const Surface& surface, double wanted) {
  constexpr double kCoarsest = 0x1p60;  // in units of the spacing that is wanted
  constexpr std::size_t kEnough = 64, kMost = 20000;
  for (double coarse = kCoarsest * wanted; coarse > wanted; coarse /= 2) {
    const std::size_t n = surface.samples(coarse).size();
    if (n < kEnough) continue;
    return std::max(wanted, coarse * std::sqrt(static_cast<double>(n) / kMost));
  }
  return wanted;
}

/// Behind a surface that ends somewhere is not yet inside.
bool has_edge(const Surface& surface) {
  const Place somewhere = surface.seed(Eigen::Vector3d::Zero());
  return std::isfinite(surface.edge_distance(somewhere));
}

}  // namespace

/// Covers the surface that takes fewer samples; one without bounds has none.
ContactSearch::Cover ContactSearch::cover(const Surface& on_B, const Surface& on_A, double wanted) {
  Cover cover;
  cover.spacing = std::max(affordable_spacing(on_B, wanted), affordable_spacing(on_A, wanted));
  std::vector<Place> places_A = on_A.samples(cover.spacing), places_B = on_B.samples(cover.spacing);
  cover.on_A = !places_A.empty() && (places_B.empty() || places_A.size() <= places_B.size());
  cover.places = std::move(cover.on_A ? places_A : places_B);
  Eigen::AlignedBox3d box;
  for (const Place& place : cover.places) {
    cover.points.push_back((cover.on_A ? on_A : on_B).evaluate(place));
    box.extend(cover.points.back().c);
  }
  if (!cover.places.empty()) cover.extent = box.diagonal().norm();
  return cover;
}

ContactSearch::ContactSearch(const ContactPair& pair, double spacing)
    : ContactSearch(pair, cover(*pair.on_B, *pair.on_A, spacing)) {}

ContactSearch::ContactSearch(const ContactPair& pair, Cover cover)
    : on_B_(pair.on_B.get()),
      on_A_(pair.on_A.get()),
      spacing_(cover.spacing),
      lines_(have_straight_lines(*on_B_, *on_A_, spacing_)),
      sampled_on_A_(cover.on_A),
      places_(std::move(cover.places)),
      deepest_(has_edge(other()) ? kDeepest * spacing_ : kInfinity),
      shells_(Bending::shells(kBendingSpacing * spacing_, cover.extent)),
      bending_B_(*on_B_, kBendingSpacing * spacing_, shells_),
      bending_A_(*on_A_, kBendingSpacing * spacing_, shells_) {
  for (const SurfacePoint& point : cover.points) {
    points_.push_back(point.c);
    normals_.push_back(point.n);
    curvatures_.push_back(point.K);
  }
  const std::size_t n = places_.size();
  feet_.resize(n);
  gap_.assign(n, kInfinity);
  stamp_.assign(n, -1);
  order_.resize(n);
  near_.reserve(n);
  discs_.reserve(kMaxConstraints);
  std::iota(order_.begin(), order_.end(), 0);
  neighbours_ = nearest_neighbours(points_, 1.6 * spacing_);
  if (n > 0) build(0, static_cast<int>(n));
}

int ContactSearch::build(int first, int last) {
  Eigen::AlignedBox3d box;
  for (int k = first; k < last; ++k) box.extend(points_[order_[k]]);
  const Eigen::Vector3d middle = box.center();
  Cluster cluster{order_[first], 0, 0, first, last, {-1, -1}, {}, false};
  for (int k = first; k < last; ++k)
    if ((points_[order_[k]] - middle).squaredNorm() <
        (points_[cluster.center] - middle).squaredNorm())
      cluster.center = order_[k];
  const int c = cluster.center;
  const BendingMeter meter(points_[c], normals_[c], curvatures_[c]);
  for (int k = first; k < last; ++k) {
    const int i = order_[k];
    cluster.radius = std::max(cluster.radius, (points_[i] - points_[c]).norm());
    if (i != c)
      cluster.bend =
          std::max(cluster.bend, meter.at(points_[i], normals_[i], spacing_).over_quadric);
  }
  const int index = static_cast<int>(clusters_.size());
  clusters_.push_back(cluster);
  if (last - first > kLeafSize) {
    Eigen::Index axis;
    box.sizes().maxCoeff(&axis);
    const int half = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                     [&](int a, int b) { return points_[a][axis] < points_[b][axis]; });
    const int low = build(first, half), high = build(half, last);
    clusters_[index].child[0] = low;
    clusters_[index].child[1] = high;
  }
  return index;
}

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
  const double opening = -largest_principal(trace, square) - cluster.bend -
                         bending.within(tangential.norm() + r, cluster.other.near, at.K);
  const double slope = off_normal(up, n).norm();
  if (opening > 0 && slope < opening * r) return slope * slope / (2 * opening);
  return slope * r - 0.5 * opening * r * r;
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
      const double way = 1.05 * cluster.radius;
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

bool ContactSearch::is_lowest_of_neighbours(int sample) const {
  for (const int other : neighbours_[sample]) {
    if (other < 0 || stamp_[other] != now_) continue;
    // One that faces nothing known stands for nothing, however low it is.
    if (this->other().edge_distance(feet_[other].place) < 0) continue;
    if (gap_[other] < gap_[sample] || (gap_[other] == gap_[sample] && other < sample)) return false;
  }
  return true;
}

/// Newton to the minimum near a sample. Where that does not settle, or leads beyond the known part
/// while the sample itself is within, the sample stands for it.
GapMinimum ContactSearch::refine(int sample, const RigidTransform& X_BA) const {
  GapMinimum minimum;
  minimum.on_A = sampled_on_A_ ? places_[sample] : feet_[sample].place;
  minimum.on_B = sampled_on_A_ ? feet_[sample].place : places_[sample];
  Place refined_B = minimum.on_B, refined_A = minimum.on_A;
  minimum.refined = refine_minimum(*on_B_, refined_B, *on_A_, refined_A, X_BA, 4 * spacing_) &&
                    edge_of(refined_B, refined_A) > -kBeyondEdge * spacing_;
  if (minimum.refined) {
    minimum.on_B = refined_B;
    minimum.on_A = refined_A;
  } else if (sampled_on_A_) {
    minimum.on_B = on_B_->closest(X_BA * points_[sample], minimum.on_B);
  } else {
    minimum.on_A = on_A_->closest(X_BA.inverse() * points_[sample], minimum.on_A);
  }
  const SurfacePoint B = on_B_->evaluate(minimum.on_B);
  const SurfacePoint A = on_A_->evaluate(minimum.on_A);
  minimum.point_B = B.c;
  minimum.n = B.n;
  minimum.gap = B.n.dot(X_BA * A.c - B.c);
  minimum.edge = edge_of(minimum.on_B, minimum.on_A);
  return minimum;
}

void ContactSearch::add_minimum(int sample,
                                const RigidTransform& X_BA,
                                double cutoff,
                                std::vector<GapMinimum>& minima) {
  const GapMinimum minimum = refine(sample, X_BA);
  found_.push_back(sampled_on_A_ ? minimum.point_B : X_BA.inverse() * minimum.point_B);
  if (lines_ && add_line_ends(*on_B_, *on_A_, X_BA, minimum, spacing_, cutoff, minima)) return;
  if (minimum.gap < cutoff) minima.push_back(minimum);
}

bool ContactSearch::faces_known_part(int sample) const {
  return other().edge_distance(feet_[sample].place) >= 0;
}

/// In a shallow valley a second minimum may have no sample that is lowest of its neighbours. Does
/// the paraboloid at this one lead below the cutoff at a place that is not known yet?
bool ContactSearch::leads_elsewhere(int sample, const RigidTransform& X_BA, double cutoff) const {
  if (!feet_[sample].close) return false;
  const RigidTransform X = from_to(X_BA);
  const auto minimum = predict_minimum(X * points_[sample], X.R * normals_[sample],
                                       X.R * curvatures_[sample] * X.R.transpose(),
                                       feet_[sample].at, gap_[sample], 1.5 * spacing_);
  if (!minimum || minimum->gap > cutoff + kModel * spacing_) return false;
  const double near = kSame * spacing_;
  return std::none_of(found_.begin(), found_.end(), [&](const Eigen::Vector3d& known) {
    return (known - minimum->point).squaredNorm() < near * near;
  });
}

RigidTransform ContactSearch::from_to(const RigidTransform& X_BA) const {
  return sampled_on_A_ ? X_BA : X_BA.inverse();
}

double ContactSearch::edge_of(const Place& on_B, const Place& on_A) const {
  return std::min(on_B_->edge_distance(on_B), on_A_->edge_distance(on_A));
}

void ContactSearch::find(const RigidTransform& X_BA,
                         double cutoff,
                         std::vector<GapMinimum>& minima,
                         double merge,
                         const std::vector<KnownContact>& known) {
  minima.clear();
  near_.clear();
  ++now_;
  if (places_.empty()) return;
  set_discs(known);
  // Look a little higher than the cutoff, keep what the refinement says.
  visit(0, from_to(X_BA), cutoff + kValley * spacing_);
  found_.clear();
  for (const KnownContact& contact : known)
    found_.push_back(sampled_on_A_ ? contact.on_B : contact.on_A);
  for (const int sample : near_)
    if (faces_known_part(sample) && is_lowest_of_neighbours(sample))
      add_minimum(sample, X_BA, cutoff, minima);
  for (const int sample : near_)
    if (gap_[sample] < kValley * spacing_ && faces_known_part(sample) &&
        leads_elsewhere(sample, X_BA, cutoff))
      add_minimum(sample, X_BA, cutoff, minima);
  std::sort(minima.begin(), minima.end(),
            [](const GapMinimum& a, const GapMinimum& b) { return a.gap < b.gap; });
  std::size_t kept = 0;
  for (const GapMinimum& minimum : minima) {
    bool isolated = true;
    for (std::size_t k = 0; k < kept && isolated; ++k)
      isolated = (minima[k].point_B - minimum.point_B).norm() > merge;
    if (isolated) minima[kept++] = minimum;
  }
  minima.resize(kept);
}

void ContactSearch::find_nearest(const RigidTransform& X_BA,
                                 double reach,
                                 std::vector<GapMinimum>& minima,
                                 double merge) {
  const bool asked_before = nearest_reach_ == reach && nearest_merge_ == merge &&
                            nearest_X_.p == X_BA.p && nearest_X_.R == X_BA.R;
  if (!asked_before) {
    find_within(X_BA, reach, nearest_, merge);
    nearest_X_ = X_BA;
    nearest_reach_ = reach;
    nearest_merge_ = merge;
  }
  minima = nearest_;
}

void ContactSearch::find_within(const RigidTransform& X_BA,
                                double reach,
                                std::vector<GapMinimum>& minima,
                                double merge) {
  for (double cutoff = spacing_;; cutoff *= 4) {
    find(X_BA, std::min(cutoff, reach), minima, merge);
    if (!minima.empty() || cutoff >= reach) return;
  }
}

std::vector<ContactSearch> make_searches(const Model& model) {
  std::vector<ContactSearch> searches;
  searches.reserve(model.pairs.size());
  for (const ContactPair& pair : model.pairs)
    searches.emplace_back(pair, kSampleSpacing * model.length);
  return searches;
}

}  // namespace condyle
