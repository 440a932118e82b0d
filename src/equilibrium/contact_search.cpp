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

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLeafSize = 8;
// All in sample spacings:
constexpr double kDeepest = 12;  // overlap of a surface with an edge that is still taken for one
constexpr double kBendingSpacing = 2;
constexpr double kValley = 0.06;    // least depth that is allowed for a minimum between samples
constexpr double kHalfCell = 0.75;  // from a sample to the farthest place that it stands for
constexpr double kSame = 0.3;       // a minimum predicted nearer to one that is known is that one
constexpr double kModel = 0.01;  // what the paraboloid of the gap may be wrong by within its reach

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

/// A surface without an edge turns away all around, within few cells: it takes finer ones.
double bending_spacing(const Surface& surface) { return has_edge(surface) ? kBendingSpacing : 1; }

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
      bending_B_(*on_B_, bending_spacing(*on_B_) * spacing_, shells_),
      bending_A_(*on_A_, bending_spacing(*on_A_) * spacing_, shells_),
      valley_(valley_depth()) {
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
  found_.reserve(n + kMaxConstraints);
  discs_.reserve(kMaxConstraints);
  std::iota(order_.begin(), order_.end(), 0);
  neighbours_ = nearest_neighbours(points_, 1.6 * spacing_);
  if (n > 0) build(0, static_cast<int>(n));
}

/// By how much a minimum between samples may lie lower than the nearest of them: half the greatest
/// relative curvature times the square of its distance.
double ContactSearch::valley_depth() const {
  const double convexity = bending_B_.greatest_convexity() + bending_A_.greatest_convexity();
  const double half_cell = kHalfCell * spacing_;
  return std::max(kValley * spacing_, 0.5 * convexity * half_cell * half_cell);
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

bool ContactSearch::is_lowest_of_neighbours(int sample) const {
  for (const int other : neighbours_[sample]) {
    if (other < 0 || stamp_[other] != now_) continue;
    // One that faces nothing known stands for nothing, however low it is.
    if (!faces_known_part(other)) continue;
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
                                bool lowest,
                                std::vector<GapMinimum>& minima) {
  const GapMinimum minimum = refine(sample, X_BA);
  // A sample stands for a minimum of its own only where it is the lowest and faces what is known.
  if (!minimum.refined && !(lowest && faces_known_part(sample))) return;
  found_.push_back(sampled_on_A_ ? minimum.point_B : X_BA.inverse() * minimum.point_B);
  if (lines_ && add_line_ends(*on_B_, *on_A_, X_BA, minimum, spacing_, cutoff, minima)) return;
  if (minimum.gap < cutoff) minima.push_back(minimum);
}

bool ContactSearch::faces_known_part(int sample) const {
  return other().edge_distance(feet_[sample].place) >= 0;
}

/// A sample whose closest point lies less than a cell beyond the edge may stand for a minimum
/// within.
bool ContactSearch::nearly_faces_known_part(int sample) const {
  return other().edge_distance(feet_[sample].place) >= -spacing_;
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
  visit(0, from_to(X_BA), cutoff + valley_);
  found_.clear();
  for (const KnownContact& contact : known)
    found_.push_back(sampled_on_A_ ? contact.on_B : contact.on_A);
  for (const int sample : near_)
    if (nearly_faces_known_part(sample) && is_lowest_of_neighbours(sample))
      add_minimum(sample, X_BA, cutoff, /*lowest=*/true, minima);
  for (const int sample : near_)
    if (gap_[sample] < valley_ && nearly_faces_known_part(sample) &&
        leads_elsewhere(sample, X_BA, cutoff))
      add_minimum(sample, X_BA, cutoff, /*lowest=*/false, minima);
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
