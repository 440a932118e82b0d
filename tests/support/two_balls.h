#pragma once

/// A second contact law for tests: a spring between two balls. U = k d²/2 with the depth
/// d = R_B + R_A - |b - a|, b and a the centres; so the force k d along their line, and derivatives
/// in closed form. It has what a law may have: a thing that it holds while a pose is solved (the
/// stiffness, half of it until the first pose is solved), and an objection of its own.

#include <algorithm>
#include <memory>

#include <Eigen/Geometry>

#include "condyle/contact/contact_law.h"
#include "condyle/contact/contact_pair.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle::test {

struct TwoBalls {
  Eigen::Vector3d center_B, center_A;  ///< ground frame; A's frame [mm]
  double radius_B, radius_A;           ///< [mm]
  double stiffness;                    ///< k [N/mm]
  double deepest = 1e9;                ///< a greater depth is no pose [mm]
  bool coarse_first = false;           ///< k/2 is held until a pose is solved
};

/// How often a law was asked for what.
struct LawCount {
  int made = 0, prepared = 0, refined = 0, added = 0;
};

class BallSpring final : public ContactPotential {
 public:
  BallSpring(const TwoBalls& balls, LawCount* count) : balls_(balls), count_(count) {
    if (count_ != nullptr) ++count_->made;
    reset();
  }
  void reset() override { held_ = balls_.coarse_first ? 0.5 : 1; }
  void prepare(const RigidTransform&) override {
    if (count_ != nullptr) ++count_->prepared;
  }
  bool accepts(const RigidTransform&) override {
    if (held_ == 1) return true;
    held_ = 1;
    if (count_ != nullptr) ++count_->refined;
    return false;
  }
  double add_to(const RigidTransform& X_BA, Wrench& wrench) override {
    if (count_ != nullptr) ++count_->added;
    const At at = evaluate(X_BA);
    const double p = k() * at.depth;
    if (p == 0) return 0;
    // dn = (I - n nᵀ)/r (da + dπ x s), so that F = p n has the derivative V = p (I - n nᵀ)/r - k n nᵀ
    // with respect to the centre: that of a line element that pushes.
    const Eigen::Matrix3d nn = at.n * at.n.transpose();
    const Eigen::Matrix3d V = p / at.distance * (Eigen::Matrix3d::Identity() - nn) - k() * nn;
    const Eigen::Matrix3d S = skew(at.s);
    const Eigen::Vector3d F = p * at.n;
    wrench.f += F;
    wrench.m += at.s.cross(F);
    wrench.F1 += V;
    wrench.F2 -= V * S;
    wrench.M1 += S * V;
    wrench.M2 += at.s * F.transpose() - S * V * S;
    wrench.M2.diagonal().array() -= at.s.dot(F);
    return p;
  }
  double energy(const RigidTransform& X_BA) override {
    const double d = evaluate(X_BA).depth;
    return 0.5 * k() * d * d;
  }
  std::optional<Objection> describe(const RigidTransform& X_BA, ContactResult& result) override {
    const At at = evaluate(X_BA);
    ContactPointResult point;
    point.force = k() * at.depth;
    point.normal_ground = at.n;
    point.point_ground = balls_.center_B + balls_.radius_B * at.n;
    point.point_moving = X_BA.inverse() * point.point_ground;
    point.gap = at.distance - balls_.radius_B - balls_.radius_A;
    point.relative_curvature.fill(1 / balls_.radius_B + 1 / balls_.radius_A);
    result.closed = point.force > 0;
    result.force = point.force;
    result.resultant_ground = point.point_ground;
    result.points.push_back(point);
    if (at.depth <= balls_.deepest) return std::nullopt;
    return Objection{PoseStatus::kOverlap, "the balls are too deep in each other"};
  }

 private:
  struct At {
    Eigen::Vector3d s, n;  ///< arm of A's centre; unit, from B's centre to A's
    double distance, depth;
  };
  [[nodiscard]] double k() const { return held_ * balls_.stiffness; }
  [[nodiscard]] At evaluate(const RigidTransform& X_BA) const {
    const Eigen::Vector3d s = X_BA.R * balls_.center_A;
    const Eigen::Vector3d way = X_BA.p + s - balls_.center_B;
    const double distance = way.norm();
    return {s, way / distance, distance,
            std::max(0.0, balls_.radius_B + balls_.radius_A - distance)};
  }

  TwoBalls balls_;
  LawCount* count_;
  double held_ = 1;
};

/// `count` may be null, else it must outlive what is made.
inline ContactPair pair_of_balls(const TwoBalls& balls, LawCount* count = nullptr) {
  ContactPair pair;
  pair.name = "balls";
  pair.on_B = make_sphere(balls.center_B, balls.radius_B, true);
  pair.on_A = make_sphere(balls.center_A, balls.radius_A, true);
  pair.mode = ContactMode::kOpen;
  pair.law = [balls, count](const ContactPair&) {
    return std::make_unique<BallSpring>(balls, count);
  };
  return pair;
}

}  // namespace condyle::test
