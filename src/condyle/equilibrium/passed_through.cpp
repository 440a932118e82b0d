#include "condyle/equilibrium/passed_through.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/surface/has_edge.h"

namespace condyle {
namespace {

constexpr double kSpacing = 0.2;    // of the samples [L]
constexpr double kFinest = 0.25;    // of them on a small surface [its radius]
constexpr double kDensest = 0.125;  // of them on one that is large beside the model [its radius]
constexpr double kOpposed = -0.5;   // cosine between normals that face each other
constexpr double kMoved = 0.8;      // of the depth that the search sees: less is no way through it
constexpr std::size_t kFew = 3;  // fewer samples may have met closest points far from the true ones

/// A plane or a cylinder that ends somewhere: closest points on it are exact, and what lies behind its known part is solid
/// however deep. Behind a patch, or a polynomial that stands for one, a bone may end.
bool bounds_deep_solid(const Surface& surface) {
  return has_edge(surface) && surface.bends_evenly();
}

/// Signed distances of samples from the other surface [mm].
struct Gaps {
  std::vector<double> facing;  ///< of those that face its known part
  std::vector<double> all;     ///< beyond an edge from the surface as it goes on there
};

/// Which samples are farther than that from all samples of the other surface: the others are no
/// deeper behind it.
template <typename Samples>
class FarFrom {
 public:
  FarFrom(const Samples& others, double far) : others_(others), square_(far * far) {}
  bool operator()(const Eigen::Vector3d& p) {
    const auto near = [&](const auto& other) { return (other.c - p).squaredNorm() < square_; };
    if (last_ < others_.size() && near(others_[last_])) return false;
    const auto first = std::find_if(others_.begin(), others_.end(), near);
    last_ = static_cast<std::size_t>(first - others_.begin());
    return first == others_.end();
  }

 private:
  const Samples& others_;
  double square_;
  std::size_t last_ = 0;  ///< that was near
};

/// Gaps of the samples that are wanted: visit(gap, closest point is known, they face each other).
template <typename Samples, typename Wanted, typename Visit>
void visit_gaps(const Samples& samples,
                const RigidTransform& X,
                const Surface& other,
                Wanted wanted,
                Visit visit) {
  for (const auto& sample : samples) {
    const Eigen::Vector3d p = X * sample.c;
    if (!wanted(p)) continue;
    const Place closest = other.closest(p, other.seed(p));
    const SurfacePoint at = other.evaluate_frame(closest);
    visit(at.n.dot(p - at.c), other.edge_distance(closest) > 0,
          at.n.dot(X.R * sample.n) < kOpposed);
  }
}

template <typename Samples>
Gaps gaps_of(const Samples& samples, const RigidTransform& X, const Surface& other) {
  Gaps gaps;
  const auto any = [](const Eigen::Vector3d&) { return true; };
  visit_gaps(samples, X, other, any, [&](double gap, bool known, bool faces) {
    gaps.all.push_back(gap);
    if (known && faces) gaps.facing.push_back(gap);
  });
  return gaps;
}

/// The third lowest, of fewer none: one or two samples may have met a closest point far from the true one.
double low(std::vector<double>& values) {
  if (values.size() < kFew) return std::numeric_limits<double>::infinity();
  const auto third = values.begin() + (kFew - 1);
  std::nth_element(values.begin(), third, values.end());
  return *third;
}

/// Closed about nothing, the solid all around it: by the sign of its volume, ∮ c.n dA. What lies in that solid as
/// a whole comes near no point of the surface.
bool is_hollow(const Surface& surface) {
  constexpr double kCoarse = 0.25;  // spacing of samples [radius]
  const Extent extent = surface.extent();
  if (has_edge(surface) || !std::isfinite(extent.radius)) return false;
  double volume = 0;
  for (const Place& place : surface.samples(kCoarse * extent.radius)) {
    const SurfacePoint at = surface.evaluate_frame(place);
    volume += at.n.dot(at.c - extent.center);
  }
  return volume < 0;
}

}  // namespace

PassedThrough::PassedThrough(const ContactPair& pair, double L, double seen)
    : on_B_(pair.on_B.get()), on_A_(pair.on_A.get()), L_(L), seen_(std::min(kDeep * L, seen)) {
  // Closed surfaces about solids are searched to any depth.
  ends_ = has_edge(*on_B_) || has_edge(*on_A_);
  if (pair.mode != ContactMode::kAuto || !(ends_ || is_hollow(*on_B_) || is_hollow(*on_A_))) return;
  const auto sample = [L](const Surface& surface) {
    std::vector<Sample> samples;
    const double radius = surface.extent().radius;
    const double spacing = std::max(std::min(kSpacing * L, kFinest * radius), kDensest * radius);
    for (const Place& place : surface.samples(spacing)) {
      if (surface.edge_distance(place) < 0) continue;
      const SurfacePoint at = surface.evaluate_frame(place);
      samples.push_back({at.c, at.n});
    }
    return samples;
  };
  samples_B_ = sample(*on_B_);
  samples_A_ = sample(*on_A_);
  whole_ = bounds_deep_solid(*on_B_) || bounds_deep_solid(*on_A_);
  ball_B_ = ball_about(samples_B_);
  ball_A_ = ball_about(samples_A_);
}

/// Do enough samples lie deep enough?
bool PassedThrough::may_be_deep(const RigidTransform& X_BA, double deep) const {
  std::size_t count = 0;
  const auto count_deep = [&](double gap, bool, bool) { count += gap <= -deep ? 1 : 0; };
  visit_gaps(samples_A_, X_BA, *on_B_, FarFrom(samples_B_, deep), count_deep);
  visit_gaps(samples_B_, X_BA.inverse(), *on_A_, FarFrom(samples_A_, deep), count_deep);
  return count >= kFew;
}

std::optional<double> PassedThrough::depth(const RigidTransform& X_BA) const {
  return ends_ ? depth_beyond(X_BA, kDeep * L_) : std::nullopt;
}

std::optional<double> PassedThrough::depth_beyond(const RigidTransform& X_BA, double deep) const {
  if (!may_be_deep(X_BA, deep)) return std::nullopt;
  Gaps of_A = gaps_of(samples_A_, X_BA, *on_B_), of_B = gaps_of(samples_B_, X_BA.inverse(), *on_A_);
  // Each for itself: what lies behind a short edge, few samples of one surface may face, and many of the
  // other's face the one from afar, as those across a hollow cylinder face a ball beside it.
  double gap = std::min(low(of_A.facing), low(of_B.facing));
  if (of_A.facing.size() + of_B.facing.size() < kFew) {
    of_A.all.insert(of_A.all.end(), of_B.all.begin(), of_B.all.end());
    gap = low(of_A.all);
  }
  if (gap > -deep) return std::nullopt;
  return -gap;
}

PassedThrough::Ball PassedThrough::ball_about(const std::vector<Sample>& samples) {
  Ball ball;
  for (const Sample& at : samples) ball.center += at.c / static_cast<double>(samples.size());
  for (const Sample& at : samples) ball.radius = std::max(ball.radius, (at.c - ball.center).norm());
  return ball;
}

/// Is nothing of the ball deeper behind a plane or a cylinder than `deep`? Distances from these change by no more than the
/// way between two points.
bool PassedThrough::is_in_front(const Ball& ball,
                                const RigidTransform& X,
                                const Surface& other,
                                double deep) {
  const Eigen::Vector3d p = X * ball.center;
  const SurfacePoint at = other.evaluate_frame(other.closest(p, other.seed(p)));
  return at.n.dot(p - at.c) - ball.radius > -deep;
}

/// How deep samples lie behind a surface that bounds a deep solid, facing it or not: behind its known part, or
/// beyond its edge as well. Nothing where that is less than `deep`.
std::optional<double> PassedThrough::depth_in_solid(const RigidTransform& X_BA,
                                                    double deep,
                                                    bool beyond_edge) const {
  if (!whole_) return std::nullopt;
  double lowest = 0;
  const auto look = [&](const std::vector<Sample>& samples, const Ball& ball,
                        const RigidTransform& X, const Surface& other,
                        const std::vector<Sample>& others) {
    if (bounds_deep_solid(other) && !is_in_front(ball, X, other, deep))
      visit_gaps(samples, X, other, FarFrom(others, deep), [&](double gap, bool known, bool) {
        if (known || beyond_edge) lowest = std::min(lowest, gap);
      });
  };
  look(samples_A_, ball_A_, X_BA, *on_B_, samples_B_);
  look(samples_B_, ball_B_, X_BA.inverse(), *on_A_, samples_A_);
  if (lowest > -deep) return std::nullopt;
  return -lowest;
}

/// May a sample have moved by more than a part of `seen_` since the pose that was looked at?
bool PassedThrough::moved_far(const RigidTransform& X_BA) const {
  const RigidTransform X = samples_A_.empty() ? X_BA.inverse() : X_BA,
                       Y = samples_A_.empty() ? trusted_->inverse() : *trusted_;
  const Ball& moving = samples_A_.empty() ? ball_B_ : ball_A_;
  const double moved =
      (X * moving.center - Y * moving.center).norm() + (X.R - Y.R).norm() * moving.radius;
  return moved > kMoved * seen_;
}

std::optional<double> PassedThrough::depth_of_touching_pose(const RigidTransform& X_BA) {
  if (!whole_) {
    trusted_ = X_BA;
    return std::nullopt;
  }
  if (trusted_ && !moved_far(X_BA)) return std::nullopt;
  const std::optional<double> deep = depth_in_solid(X_BA, seen_, false);
  if (!deep) trust_if_far(X_BA);
  return deep;
}

std::optional<double> PassedThrough::depth_of_clear_pose(const RigidTransform& X_BA) {
  if (samples_A_.empty() && samples_B_.empty()) return std::nullopt;
  if (trusted_ && !moved_far(X_BA)) {
    if (!whole_) trusted_ = X_BA;
    return std::nullopt;
  }
  std::optional<double> deep = depth_beyond(X_BA, seen_);
  if (!deep) deep = depth_in_solid(X_BA, seen_, false);
  if (!deep) trust_if_far(X_BA);
  return deep;
}

/// What lies deep beyond an edge comes into a solid from the side, at any depth: such a pose tells nothing of the next.
void PassedThrough::trust_if_far(const RigidTransform& X_BA) {
  trusted_ = X_BA;
  if (depth_in_solid(X_BA, (1 - kMoved) * seen_, true)) trusted_.reset();
}

}  // namespace condyle
