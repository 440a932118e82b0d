/// The search beside contacts that are known: a quadric between the surfaces leaves few samples to
/// look at.

#include <algorithm>

#include "condyle/contact/contact_search.h"

namespace condyle {
namespace {

constexpr double kPiece = 6;  // radius of what the quadric is fitted to [sample spacings]

SurfacePoint moved(const SurfacePoint& point, const RigidTransform& X) {
  SurfacePoint there = point;
  there.c = X * point.c;
  there.n = X.R * point.n;
  there.K = X.R * point.K * X.R.transpose();
  return there;
}

}  // namespace

/// All of either surface that lies on its own side of a quadric between them is apart from the
/// other's. Looked at are the samples that do not, and those that face what does not of the other
/// surface. False where no quadric is known.
bool ContactSearch::look_beside(const RigidTransform& X_from_to, double cutoff) {
  const int near = sampled_on_A_ ? near_contact_A_ : near_contact_B_;
  const int near_other = sampled_on_A_ ? near_contact_B_ : near_contact_A_;
  if (near < 0 || near_other < 0 || sampled().bends_evenly() || other().bends_evenly())
    return false;
  const RigidTransform X_to_from = X_from_to.inverse();
  const double piece = kPiece * spacing_;
  const DividingQuadric quadric =
      divide(bending_other().quadrics().about(near_other, piece).cell.at,
             moved(bending_sampled().quadrics().about(near, piece).cell.at, X_from_to),
             other().sample(near_other).c);
  sampled().columns().not_on(CellColumns::Side::kAbove, moved(quadric, X_to_from), doubtful_);
  other().columns().not_on(CellColumns::Side::kBelow, quadric, doubtful_other_);
  int facing = near, faced = near_other;
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
  const int nearest = sampled().nearest(p, near);
  if (nearest < 0) return;  // faces nothing
  near = nearest;
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
