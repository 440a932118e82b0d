#include "condyle/contact/settle_places.h"

#include <algorithm>
#include <cmath>

#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

constexpr int kMostSteps = 30;
// Of the reach:
constexpr double kLastStep = 1e-8;  // the next would be its square
constexpr double kNoStep = 1e-12;
constexpr double kNear = 0.1;  // a step that leads to the minimum itself

constexpr double kFall = 2;          // of κ d²: more than the gap falls on the way d, ½ κ d²
constexpr double kLeastBend = 0.02;  // of the greatest: what the way downhill is divided by

/// The step for Newton's where the gap bends downwards along a direction: downhill along it.
Eigen::Vector2d downhill(const ContactLinearization& contact, const RigidTransform& X_BA) {
  const Eigen::Matrix<double, 3, 2>& T = contact.T;
  const Eigen::Matrix<double, 3, 2> Kr_T = X_BA.R * (contact.A.K * (X_BA.R.transpose() * T));
  const Eigen::Matrix2d Q = T.transpose() * (contact.K_T + Kr_T);
  const Eigen::Vector3d beside = contact.g - contact.across * contact.B.n;
  const Eigen::Vector2d mismatch = T.transpose() * contact.h + Kr_T.transpose() * beside;
  const SymmetricEigenvalues principal = symmetric_eigenvalues(Q);
  const Eigen::Vector2d size = principal.values.cwiseAbs();
  const Eigen::Vector2d bend = size.cwiseMax(kLeastBend * size.maxCoeff());
  const Eigen::Matrix2d V = principal.vectors;
  return -(V * (V.transpose() * mismatch).cwiseQuotient(bend));
}

/// How far the points slide, the one that slides farther.
double slide_of(const ContactLinearization& contact) {
  const Eigen::Vector3d dc = contact.D0();
  const Eigen::Vector3d dc_A = dc - (contact.g - contact.gap() * contact.B.n);
  return std::sqrt(std::max(dc.squaredNorm(), dc_A.squaredNorm()));
}

}  // namespace

Settled settle_places(const SurfacePair& surfaces,
                      const RigidTransform& X_BA,
                      const Settling& how,
                      ContactPlaces& places,
                      ContactLinearization& at) {
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  Eigen::Vector3d start = still;
  bool last = false;
  for (int step = 0; step <= kMostSteps; ++step) {
    at = linearize_across_gap(surfaces, places, X_BA);
    if (step == 0) start = at.B.c;
    if (!at.g.allFinite() || (at.B.c - start).norm() > how.reach) return Settled::kLost;
    const auto [least, greatest] = at.relative_curvature;
    if (how.on_minimum && least < -kFlatCurvature) at.S0 = downhill(at, X_BA);
    const double slide = slide_of(at);
    if (last || slide < kNoStep * how.reach)
      return !how.on_minimum || (least > 0 && are_opposite(at)) ? Settled::kThere : Settled::kLost;
    if (slide < kNear * how.reach && least > 0 &&
        at.gap() - kFall * greatest * slide * slide > how.cutoff)
      return Settled::kAbove;
    slide_contact(surfaces, places, at, X_BA, still, still, how.reach);
    last = slide < kLastStep * how.reach;
  }
  return Settled::kLost;
}

}  // namespace condyle
