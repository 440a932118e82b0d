/// The search beside contacts that are known: a quadric between the surfaces leaves few samples to
/// look at.

#include <algorithm>
#include <array>

#include "condyle/contact/contact_search.h"

namespace condyle {
namespace {

// Radii of what the quadric is fitted to [sample spacings].
constexpr std::array<double, 2> kPieces = {6, 14};
constexpr std::size_t kFew = 60;  // doubts that are not worth another quadric
constexpr double kMore = 1.3;     // of the doubts before: then the others are tried again

SurfacePoint moved(const SurfacePoint& point, const RigidTransform& X) {
  SurfacePoint there = point;
  there.c = X * point.c;
  there.n = X.R * point.n;
  there.K = X.R * point.K * X.R.transpose();
  return there;
}

}  // namespace

/// Lays a quadric between the surfaces; what does not lie on its own side of it is doubtful. False
/// where none is known.
bool ContactSearch::part(const Division& division,
                         const RigidTransform& X_from_to,
                         std::vector<int>& doubtful,
                         std::vector<int>& doubtful_other) {
  const NearContact& contact = near_contacts_[division.contact];
  const int near = sampled_on_A_ ? contact.on_A : contact.on_B;
  const int near_other = sampled_on_A_ ? contact.on_B : contact.on_A;
  if (near < 0 || near_other < 0) return false;
  const double piece = kPieces[division.size] * spacing_;
  const SurfacePoint& lower = bending_other().quadrics().mean_about(near_other, piece);
  const SurfacePoint& upper = bending_sampled().quadrics().mean_about(near, piece);
  const DividingQuadric quadric =
      divide(lower, moved(upper, X_from_to), other().sample(near_other).c);
  sampled().columns().not_on(CellColumns::Side::kAbove, moved(quadric, X_from_to.inverse()),
                             doubtful);
  other().columns().not_on(CellColumns::Side::kBelow, quadric, doubtful_other);
  return true;
}

/// All quadrics are tried until one leaves few doubts, and the best is kept.
void ContactSearch::part_best(const RigidTransform& X_from_to) {
  doubts_ = doubtful_.size() + doubtful_other_.size();
  const Division first = division_;
  for (Division next; next.contact < known_; ++next.contact)
    for (next.size = 0; next.size < kPieces.size(); ++next.size) {
      if (doubts_ <= kFew) return;
      const bool tried = next.contact == first.contact && next.size == first.size;
      if (tried || !part(next, X_from_to, doubtful_there_, doubtful_other_there_)) continue;
      const std::size_t doubts = doubtful_there_.size() + doubtful_other_there_.size();
      if (doubts >= doubts_) continue;
      doubts_ = doubts;
      division_ = next;
      doubtful_.swap(doubtful_there_);
      doubtful_other_.swap(doubtful_other_there_);
    }
}

/// All of either surface that lies on its own side of a quadric between them is apart from the
/// other's. Looked at are the samples that do not, and those that face what does not of the other
/// surface. False where no quadric is known.
bool ContactSearch::look_beside(const RigidTransform& X_from_to, double cutoff) {
  if (sampled().bends_evenly() || other().bends_evenly()) return false;
  if (division_.contact >= known_) division_ = Division();
  if (!part(division_, X_from_to, doubtful_, doubtful_other_)) return false;
  const auto doubts = static_cast<double>(doubtful_.size() + doubtful_other_.size());
  if (doubts > std::max<double>(kFew, kMore * static_cast<double>(doubts_))) part_best(X_from_to);
  const NearContact& contact = near_contacts_[division_.contact];
  int facing = sampled_on_A_ ? contact.on_A : contact.on_B;
  int faced = sampled_on_A_ ? contact.on_B : contact.on_A;
  for (const int sample : doubtful_) look_at(sample, faced, X_from_to, cutoff);
  for (const int sample : doubtful_other_) look_at_facing(sample, facing, X_from_to, cutoff);
  return true;
}

/// The samples that a sample of the other surface faces, unless its cell is clear of them.
void ContactSearch::look_at_facing(int sample_of_other,
                                   int& near,
                                   const RigidTransform& X_from_to,
                                   double cutoff) {
  const SurfacePoint& own = other().sample(sample_of_other);
  const RigidTransform X_to_from = X_from_to.inverse();
  const Eigen::Vector3d p = X_to_from * own.c;
  if (nearest_of_sampled().find(p, near, looked_at_) < 0) return;  // faces nothing
  if (bound_of_cell(facing_cell(sampled(), p, near), own, X_to_from.R,
                    other().cell_radius(sample_of_other), other().cell_change(sample_of_other),
                    cutoff) > cutoff)
    return;
  const auto look_once = [&](int sample) {
    if (seen(sample).stamp == now_) return;
    int faced = sample_of_other;
    look_at(sample, faced, X_from_to, cutoff);
  };
  look_once(near);
  for (const int neighbour : sampled().neighbours(near)) {
    if (neighbour < 0) break;
    look_once(neighbour);
  }
}

}  // namespace condyle
