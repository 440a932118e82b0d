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

namespace {

/// The point of one surface, that of A or of B, over the point of the other that is closest to it.
class PointOverSurface {
 public:
  PointOverSurface(const SurfacePair& surfaces, const RigidTransform& X_BA, bool point_of_A)
      : surfaces_(surfaces), X_BA_(X_BA), X_AB_(X_BA.inverse()), of_A_(point_of_A) {}

  /// Brings the other place there.
  ContactLinearization at(ContactPlaces& places) const {
    const auto& [on_B, on_A] = surfaces_;
    if (of_A_)
      places.on_B = on_B.closest(X_BA_ * on_A.evaluate(places.on_A).c, places.on_B);
    else
      places.on_A = on_A.closest(X_AB_ * on_B.evaluate(places.on_B).c, places.on_A);
    return linearize_across_gap(surfaces_, places, X_BA_);
  }

  /// By the normal of the other surface.
  [[nodiscard]] double height(const ContactLinearization& at) const {
    return of_A_ ? at.gap() : (at.B.n - at.h).dot(at.g);
  }

  [[nodiscard]] ContactPlaces by_newton(const ContactPlaces& from,
                                        ContactLinearization at,
                                        double way) const {
    if (at.relative_curvature[0] < -kFlatCurvature) at.S0 = downhill(at, X_BA_);
    ContactPlaces places = from;
    const Eigen::Vector3d still = Eigen::Vector3d::Zero();
    slide_contact(surfaces_, places, at, X_BA_, still, still, way);
    return places;
  }

  /// The steepest way.
  [[nodiscard]] ContactPlaces by_slope(const ContactPlaces& from,
                                       const ContactLinearization& at,
                                       double way) const {
    const Eigen::Vector3d n = at.B.n, m = at.h - n;
    const Eigen::Vector3d slope = of_A_ ? n - n.dot(m) * m : m - m.dot(n) * n;
    const Eigen::Vector3d dc = -way * slope.normalized();
    ContactPlaces places = from;
    if (of_A_)
      places.on_A = surfaces_.on_A.moved(from.on_A, at.A, X_AB_.R * dc);
    else
      places.on_B = surfaces_.on_B.moved(from.on_B, at.B, dc);
    return places;
  }

 private:
  SurfacePair surfaces_;
  RigidTransform X_BA_, X_AB_;
  bool of_A_;
};

}  // namespace

Settled settle_downhill(const SurfacePair& surfaces,
                        const RigidTransform& X_BA,
                        const Settling& how,
                        bool point_of_A,
                        ContactPlaces& places,
                        ContactLinearization& at,
                        long& points) {
  constexpr int kMost = 60;
  constexpr long kLook = 4, kLast = 40;  // points that it takes the time of
  constexpr double kFirst = 0.1, kPolish = 1e-3, kShortest = 1e-5;  // of the reach
  const PointOverSurface point(surfaces, X_BA, point_of_A);
  at = point.at(places);
  points += kLook + kLast;
  const Eigen::Vector3d start = at.B.c;
  double way = kFirst * how.reach;
  for (int step = 0; step < kMost && way > kShortest * how.reach; ++step) {
    if (!at.g.allFinite() || (at.B.c - start).norm() > how.reach) return Settled::kLost;
    if (at.relative_curvature[0] > 0 && slide_of(at) < kPolish * how.reach) break;
    bool lower = false;
    for (const bool newton : {true, false}) {
      ContactPlaces next =
          newton ? point.by_newton(places, at, way) : point.by_slope(places, at, way);
      const ContactLinearization there = point.at(next);
      points += kLook;
      lower = point.height(there) < point.height(at);
      if (!lower) continue;
      places = next;
      at = there;
      break;
    }
    way = lower ? std::min(2 * way, how.reach) : 0.25 * way;
  }
  ContactPlaces settled = places;
  ContactLinearization there;
  const Settled outcome = settle_places(surfaces, X_BA, how, settled, there);
  if (outcome != Settled::kThere || point.height(there) > point.height(at)) return Settled::kLost;
  places = settled;
  at = there;
  return outcome;
}

}  // namespace condyle
