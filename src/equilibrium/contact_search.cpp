#include "equilibrium/contact_search.h"

#include <Eigen/Geometry>
#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "elements/contact.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLeafSize = 8;
constexpr double kBeyondEdge =
    2;  // how far beyond the known part a minimum may lie, in sample spacings
constexpr double kSteep =
    0.7;  // sine of the angle between two surfaces beyond which curvature bounds say nothing
constexpr double kDeepest = 12;  // overlap that is still taken for one, in sample spacings

struct PointCloud {
  const std::vector<Eigen::Vector3d>& points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// The greater of the two principal values off the normal of a curvature tensor: where the sum of
/// two is positive, the gap closes sideways.
double largest_principal(const Eigen::Matrix3d& K) {
  const double trace = K.trace();
  return 0.5 * (trace + std::sqrt(std::max(0.0, 2 * K.squaredNorm() - trace * trace)));
}

}  // namespace

bool refine_minimum(const Surface& on_B,
                    Place& place_B,
                    const Surface& on_A,
                    Place& place_A,
                    const RigidTransform& X_BA,
                    double reach) {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const ContactLinearization contact = linearize_contact(on_B, place_B, on_A, place_A, X_BA);
    if (iteration == 0) start = contact.B.c;
    if (!contact.g.allFinite() || (contact.B.c - start).norm() > reach) return false;
    // At a finite gap only the tangential part of g is an error.
    const Eigen::Vector3d along = contact.gap() * contact.B.n;
    const double slide = (contact.g - along).norm() + contact.h.norm() / 0.05;
    if (slide < 1e-11) return contact.relative_curvature[0] > 0;
    Eigen::Vector3d dc = contact.D0;
    Eigen::Vector3d dc_A = dc - (contact.g - along);
    const double longest = std::max(dc.norm(), dc_A.norm());
    if (longest > reach) {
      dc *= reach / longest;
      dc_A *= reach / longest;
    }
    place_B = on_B.moved(place_B, contact.B, dc);
    place_A = on_A.moved(place_A, contact.A, X_BA.R.transpose() * dc_A);
  }
  return false;
}

ContactSearch::ContactSearch(const ContactPair& pair, double spacing)
    : on_B_(pair.on_B.get()), on_A_(pair.on_A.get()), spacing_(spacing) {
  const std::vector<Place> on_A = on_A_->samples(spacing), on_B = on_B_->samples(spacing);
  sampled_on_A_ = !on_A.empty() && (on_B.empty() || on_A.size() <= on_B.size());
  places_ = sampled_on_A_ ? on_A : on_B;
  const Surface& sampled = sampled_on_A_ ? *on_A_ : *on_B_;
  for (const Place& place : places_) {
    const SurfacePoint point = sampled.evaluate(place);
    points_.push_back(point.c);
    normals_.push_back(point.n);
    curvatures_.push_back(point.K);
  }
  const std::size_t n = places_.size();
  feet_.resize(n);
  at_feet_.resize(n);
  has_foot_.assign(n, 0);
  gap_.assign(n, kInfinity);
  slope_.assign(n, 1);
  stamp_.assign(n, -1);
  order_.resize(n);
  near_.reserve(n);
  std::iota(order_.begin(), order_.end(), 0);
  link_neighbours(1.6 * spacing);
  if (n > 0) build(0, static_cast<int>(n));
}

void ContactSearch::link_neighbours(double radius) {
  neighbours_.resize(points_.size());
  for (auto& list : neighbours_) list.fill(-1);
  if (points_.empty()) return;
  const PointCloud cloud{points_};
  const nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>,
                                            PointCloud, 3>
      tree(3, cloud);
  std::array<unsigned int, 9> index;
  std::array<double, 9> square;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::size_t found = tree.knnSearch(points_[i].data(), 9, index.data(), square.data());
    int k = 0;
    for (std::size_t j = 0; j < found && k < 8; ++j)
      if (index[j] != static_cast<unsigned int>(i) && square[j] < radius * radius)
        neighbours_[i][k++] = static_cast<int>(index[j]);
  }
}

int ContactSearch::build(int first, int last) {
  Eigen::AlignedBox3d box;
  for (int k = first; k < last; ++k) box.extend(points_[order_[k]]);
  const Eigen::Vector3d middle = box.center();
  Cluster cluster{order_[first], 0, 0, first, last, {-1, -1}};
  for (int k = first; k < last; ++k)
    if ((points_[order_[k]] - middle).squaredNorm() <
        (points_[cluster.center] - middle).squaredNorm())
      cluster.center = order_[k];
  for (int k = first; k < last; ++k) {
    cluster.radius =
        std::max(cluster.radius, (points_[order_[k]] - points_[cluster.center]).norm());
    cluster.spread =
        std::max(cluster.spread, (curvatures_[order_[k]] - curvatures_[cluster.center]).norm());
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

double ContactSearch::gap_of(int sample, const RigidTransform& X_from_to) {
  if (stamp_[sample] == now_) return gap_[sample];
  stamp_[sample] = now_;
  const Surface& other = sampled_on_A_ ? *on_B_ : *on_A_;
  const Eigen::Vector3d p = X_from_to * points_[sample];
  Place& foot = feet_[sample];
  SurfacePoint& at = at_feet_[sample];
  const double close = 0.2 * spacing_;
  double gap = kInfinity, slide = kInfinity;
  // From the foot of the pose before, or else from a seed: tangent steps towards the point.
  for (int attempt = has_foot_[sample] ? 0 : 1; attempt < 2 && slide > close; ++attempt) {
    if (attempt == 1) {
      foot = other.seed(p);
      at = other.evaluate_frame(foot);
    }
    for (int step = 0; step < 5 && slide > close; ++step) {
      const Eigen::Vector3d to_foot = p - at.c;
      const Eigen::Vector3d tangential = to_foot - to_foot.dot(at.n) * at.n;
      if (tangential.squaredNorm() > 1e-4 * close * close) {
        foot = other.moved(foot, at, tangential);
        at = other.evaluate_frame(foot);
      }
      const Eigen::Vector3d to_p = p - at.c;
      gap = to_p.dot(at.n);
      slide = (to_p - gap * at.n).norm();
    }
  }
  if (slide > close) {
    foot = other.closest(p, other.seed(p));
    at = other.evaluate_frame(foot);
    gap = std::copysign((p - at.c).norm(), (p - at.c).dot(at.n));
  }
  has_foot_[sample] = 1;
  slope_[sample] = at.n.cross(X_from_to.R * normals_[sample]).norm();
  gap_[sample] = gap;
  return gap;
}

/// Below the gap at the centre by the slope over the radius, and by the relative curvature there
/// with an allowance for how it varies within the cluster; never by more than the radius, since a
/// distance is 1-Lipschitz.
double ContactSearch::lowest_possible(const Cluster& cluster,
                                      const Eigen::Matrix3d& K_other,
                                      const Eigen::Matrix3d& R) const {
  const double r = cluster.radius, gap = gap_[cluster.center], slope = slope_[cluster.center];
  if (slope > kSteep) return gap - r;
  const Eigen::Matrix3d K = K_other + R * curvatures_[cluster.center] * R.transpose();
  const double closing = largest_principal(K) + cluster.spread + 0.5 * K_other.norm();
  return gap - std::min(r, slope * r + 0.5 * std::max(0.0, closing) * r * r);
}

void ContactSearch::visit(int index, const RigidTransform& X_from_to, double cutoff) {
  const Cluster& cluster = clusters_[index];
  const double gap = gap_of(cluster.center, X_from_to);
  // Far behind an open patch is not inside the solid.
  const double deepest = -kDeepest * spacing_;
  if (gap - cluster.radius > cutoff || gap + cluster.radius < deepest) return;
  const Surface& other = sampled_on_A_ ? *on_B_ : *on_A_;
  const SurfacePoint at = other.evaluate(feet_[cluster.center]);
  if (lowest_possible(cluster, at.K, X_from_to.R) > cutoff) return;
  if (cluster.child[0] >= 0) {
    visit(cluster.child[0], X_from_to, cutoff);
    visit(cluster.child[1], X_from_to, cutoff);
    return;
  }
  // A sample is at least as far as from the tangent plane at the centre's foot, less what the other
  // surface can bulge.
  const Eigen::Vector3d n = X_from_to.R.transpose() * at.n;
  const double bulge = 0.5 * std::max(0.0, largest_principal(at.K) + 0.5 * at.K.norm());
  for (int k = cluster.first; k < cluster.last; ++k) {
    const int sample = order_[k];
    const Eigen::Vector3d d = points_[sample] - points_[cluster.center];
    if (slope_[cluster.center] < kSteep && gap + n.dot(d) - bulge * d.squaredNorm() > cutoff)
      continue;
    const double sample_gap = gap_of(sample, X_from_to);
    if (sample_gap < cutoff && sample_gap > deepest) near_.push_back(sample);
  }
}

bool ContactSearch::is_lowest_of_neighbours(int sample) const {
  for (const int other : neighbours_[sample]) {
    if (other < 0 || stamp_[other] != now_) continue;
    if (gap_[other] < gap_[sample] || (gap_[other] == gap_[sample] && other < sample)) return false;
  }
  return true;
}

/// Newton to the minimum near a sample. Where that does not settle, or leads beyond the known part
/// while the sample itself is within, the sample stands for it.
GapMinimum ContactSearch::refine(int sample, const RigidTransform& X_BA) const {
  GapMinimum minimum;
  minimum.on_A = sampled_on_A_ ? places_[sample] : feet_[sample];
  minimum.on_B = sampled_on_A_ ? feet_[sample] : places_[sample];
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

double ContactSearch::edge_of(const Place& on_B, const Place& on_A) const {
  return std::min(on_B_->edge_distance(on_B), on_A_->edge_distance(on_A));
}

void ContactSearch::find(const RigidTransform& X_BA,
                         double cutoff,
                         std::vector<GapMinimum>& minima,
                         double merge) {
  minima.clear();
  near_.clear();
  ++now_;
  if (places_.empty()) return;
  const RigidTransform X_from_to = sampled_on_A_ ? X_BA : X_BA.inverse();
  const Surface& other = sampled_on_A_ ? *on_B_ : *on_A_;
  // A minimum between samples lies lower than both: look a little higher, keep what the refinement
  // says.
  visit(0, X_from_to, cutoff + 0.06 * spacing_);
  for (const int sample : near_) {
    if (other.edge_distance(feet_[sample]) < 0) continue;
    if (!is_lowest_of_neighbours(sample)) continue;
    const GapMinimum minimum = refine(sample, X_BA);
    if (minimum.gap < cutoff) minima.push_back(minimum);
  }
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

}  // namespace condyle
