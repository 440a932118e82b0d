#include "condyle/equilibrium/passed_through.h"

#include <algorithm>

#include "condyle/surface/has_edge.h"

namespace condyle {
namespace {

constexpr double kSpacing = 0.2;   // of the samples [L]
constexpr double kOpposed = -0.5;  // cosine between normals that face each other
constexpr std::size_t kFew = 3;    // fewer samples tell nothing

/// Signed distances of samples from the other surface [mm].
struct Gaps {
  std::vector<double> facing;  ///< of those that face its known part
  std::vector<double> all;     ///< beyond an edge from the surface as it goes on there
};

template <typename Samples>
void add_gaps(const Samples& samples, const RigidTransform& X, const Surface& other, Gaps& gaps) {
  for (const auto& sample : samples) {
    const Eigen::Vector3d p = X * sample.c;
    const Place closest = other.closest(p, other.seed(p));
    const SurfacePoint at = other.evaluate_frame(closest);
    const double gap = at.n.dot(p - at.c);
    gaps.all.push_back(gap);
    if (other.edge_distance(closest) > 0 && at.n.dot(X.R * sample.n) < kOpposed)
      gaps.facing.push_back(gap);
  }
}

/// The third lowest: one or two samples may have met a closest point far from the true one.
double low(std::vector<double>& values) {
  const auto third = values.begin() + (kFew - 1);
  std::nth_element(values.begin(), third, values.end());
  return *third;
}

}  // namespace

PassedThrough::PassedThrough(const ContactPair& pair, double L)
    : on_B_(pair.on_B.get()), on_A_(pair.on_A.get()), L_(L) {
  // Closed surfaces are searched to any depth.
  if (pair.mode != ContactMode::kAuto || !(has_edge(*on_B_) || has_edge(*on_A_))) return;
  const auto sample = [L](const Surface& surface) {
    std::vector<Sample> samples;
    for (const Place& place : surface.samples(kSpacing * L)) {
      if (surface.edge_distance(place) < 0) continue;
      const SurfacePoint at = surface.evaluate_frame(place);
      samples.push_back({at.c, at.n});
    }
    return samples;
  };
  samples_B_ = sample(*on_B_);
  samples_A_ = sample(*on_A_);
}

std::optional<double> PassedThrough::depth(const RigidTransform& X_BA) const {
  Gaps gaps;
  add_gaps(samples_A_, X_BA, *on_B_, gaps);
  add_gaps(samples_B_, X_BA.inverse(), *on_A_, gaps);
  if (gaps.all.size() < kFew) return std::nullopt;
  const double gap = low(gaps.facing.size() < kFew ? gaps.all : gaps.facing);
  if (gap > -kDeep * L_) return std::nullopt;
  return -gap;
}

bool PassedThrough::moved_far(const RigidTransform& X_BA) const {
  const auto any_far = [this](const std::vector<Sample>& samples, const RigidTransform& X,
                              const RigidTransform& Y) {
    const double far = 0.8 * kDeep * L_;
    return std::any_of(samples.begin(), samples.end(), [&](const Sample& sample) {
      return (X * sample.c - Y * sample.c).squaredNorm() > far * far;
    });
  };
  return any_far(samples_A_, X_BA, *trusted_) ||
         (samples_A_.empty() && any_far(samples_B_, X_BA.inverse(), trusted_->inverse()));
}

std::optional<double> PassedThrough::depth_of_clear_pose(const RigidTransform& X_BA) {
  if (samples_A_.empty() && samples_B_.empty()) return std::nullopt;
  if (!trusted_ || moved_far(X_BA)) {
    if (const std::optional<double> deep = depth(X_BA)) return deep;
  }
  trusted_ = X_BA;
  return std::nullopt;
}

}  // namespace condyle
