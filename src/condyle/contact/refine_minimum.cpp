#include "condyle/contact/refine_minimum.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

#include "condyle/contact/contact.h"

namespace condyle {
namespace {

constexpr double kNear = 0.1;  // of the reach: a step that leads to the minimum itself
constexpr double kFall = 2;    // of κ d²: more than the gap falls on the way d, ½ κ d²

/// How far the point slides towards the minimum: by Newton, or, where the gap bends downwards along
/// a direction, downhill along it, so that no saddle attracts.
Eigen::Vector3d slide_downhill(const ContactLinearization& contact, const RigidTransform& X_BA) {
  if (contact.relative_curvature[0] > -kFlatCurvature) return contact.D0();
  const Eigen::Matrix<double, 3, 2>& T = contact.T;
  const Eigen::Matrix<double, 3, 2> Kr_T = X_BA.R * (contact.A.K * (X_BA.R.transpose() * T));
  const Eigen::Matrix2d Q = T.transpose() * (contact.K_T + Kr_T);
  const Eigen::Vector2d mismatch = T.transpose() * contact.h + Kr_T.transpose() * contact.g;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(Q);
  const Eigen::Vector2d size = principal.eigenvalues().cwiseAbs();
  const Eigen::Vector2d bend = size.cwiseMax(0.02 * size.maxCoeff());
  const Eigen::Matrix2d& V = principal.eigenvectors();
  return -(T * (V * (V.transpose() * mismatch).cwiseQuotient(bend)));
}

}  // namespace

bool refine_minimum(const SurfacePair& surfaces,
                    ContactPlaces& places,
                    const RigidTransform& X_BA,
                    double reach) {
  constexpr double kAnyGap = std::numeric_limits<double>::infinity();
  return refine_minimum_below(kAnyGap, surfaces, places, X_BA, reach) == Refinement::kSettled;
}

Refinement refine_minimum_below(double cutoff,
                                const SurfacePair& surfaces,
                                ContactPlaces& places,
                                const RigidTransform& X_BA,
                                double reach) {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const ContactLinearization contact = linearize_contact(surfaces, places, X_BA);
    if (iteration == 0) start = contact.B.c;
    if (!contact.g.allFinite() || (contact.B.c - start).norm() > reach) return Refinement::kLost;
    // At a finite gap only the tangential part of g is an error.
    const Eigen::Vector3d along = contact.gap() * contact.B.n;
    const double slide = (contact.g - along).norm() + contact.h.norm() / 0.05;
    if (slide < 1e-11)
      return contact.relative_curvature[0] > 0 ? Refinement::kSettled : Refinement::kLost;
    Eigen::Vector3d dc = slide_downhill(contact, X_BA);
    Eigen::Vector3d dc_A = dc - (contact.g - along);
    const double longest = std::max(dc.norm(), dc_A.norm());
    if (longest < kNear * reach && contact.relative_curvature[0] > 0 &&
        contact.gap() - kFall * contact.relative_curvature[1] * longest * longest > cutoff)
      return Refinement::kAbove;
    if (longest > reach) {
      dc *= reach / longest;
      dc_A *= reach / longest;
    }
    places.on_B = surfaces.on_B.moved(places.on_B, contact.B, dc);
    places.on_A = surfaces.on_A.moved(places.on_A, contact.A, X_BA.R.transpose() * dc_A);
  }
  return Refinement::kLost;
}

}  // namespace condyle
