#pragma once

/// A knee of exact surfaces for tests and measurements: two ellipsoidal condyles on a spherical cup
/// (medial) and an inclined plane (lateral), eight toe-linear ligaments, a compressive load along
/// the tibia, flexion prescribed. A right knee with x lateral, y anterior, z proximal; its sizes
/// are plausible, not those of a person. Both contacts stay closed from 0 to 120 degrees.

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/equilibrium/model.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle::test {

/// The same knee told in another way.
struct QuadricKneeView {
  RigidTransform X = {};     ///< the ground frame turned and moved, in the unit of length below
  double unit = 1;           ///< of length: 1 for mm, 0.1 for cm, 0.001 for m
  bool left = false;         ///< mirrored
  bool femur_moves = false;  ///< else the tibia does
};

/// One ligament: ends as they lie in extension, where both bodies' frames coincide.
struct QuadricLigament {
  const char* name;
  double femur[3], tibia[3];  // [mm]
  double stiffness;           // [N]
  double strain;              // in extension [-]
};

inline constexpr QuadricLigament kQuadricLigaments[] = {
    {"aACL", {7.5, -9.0, 4.0}, {-1.0, 11.0, -25.0}, 5000, 0.00},
    {"pACL", {8.0, -13.0, 1.0}, {1.0, 5.0, -25.5}, 5000, 0.03},
    {"aPCL", {-5.0, -1.0, -4.0}, {1.0, -27.0, -31.0}, 9000, -0.09},
    {"pPCL", {-4.0, -6.0, -4.0}, {-2.0, -29.0, -32.0}, 9000, -0.03},
    {"aMCL", {-42.0, 1.0, 3.0}, {-27.0, 6.0, -78.0}, 2750, 0.00},
    {"pMCL", {-42.0, -3.0, 2.0}, {-30.0, -6.0, -72.0}, 2750, 0.03},
    {"LCL", {41.0, -2.0, 2.0}, {43.0, -22.0, -48.0}, 4000, 0.04},
    {"capsule", {4.0, -26.0, 8.0}, {2.0, -27.0, -42.0}, 2500, 0.05}};

/// Takes points and directions of the right knee in mm to a view.
class QuadricKneeFrame {
 public:
  QuadricKneeFrame(const QuadricKneeView& view, bool ground)
      : X_(ground ? view.X : RigidTransform()), unit_(view.unit), mirror_(view.left ? -1 : 1) {}
  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector3d& v) const {
    return X_.R * Eigen::Vector3d(mirror_ * v.x(), v.y(), v.z());
  }
  [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector3d& p) const {
    return direction(unit_ * p) + X_.p;
  }
  [[nodiscard]] Eigen::Matrix3d axes(const Eigen::Matrix3d& R) const {
    Eigen::Matrix3d turned;
    for (int k = 0; k < 3; ++k) turned.col(k) = direction(R.col(k));
    return turned;
  }
  [[nodiscard]] const RigidTransform& transform() const { return X_; }

 private:
  RigidTransform X_;
  double unit_, mirror_;
};

/// 200 N along the tibia: carried by it where it moves, else the reaction on the femur along a line
/// that does not move.
inline Load quadric_compression(const QuadricKneeView& view, const QuadricKneeFrame& tibia) {
  Load load;
  const Eigen::Vector3d force = tibia.direction({0, 0, 200}), at = tibia.point({-3, -4, -30});
  if (!view.femur_moves) {
    load.follows_body = true;
    load.vector = force;
    load.at = at;
    return load;
  }
  load.custom = [force, at](const RigidTransform& X_BA, Wrench& wrench) {
    wrench.f -= force;
    wrench.m -= (at - X_BA.p).cross(force);
    wrench.M1 -= skew(force);
  };
  return load;
}

inline Model quadric_knee(const QuadricKneeView& view = {}) {
  const QuadricKneeFrame femur(view, !view.femur_moves), tibia(view, view.femur_moves);
  Model model;
  for (const QuadricLigament& ligament : kQuadricLigaments) {
    const Eigen::Vector3d f(ligament.femur), t(ligament.tibia);
    ToeLinearLaw law;
    law.stiffness = ligament.stiffness;
    law.slack_length = view.unit * (t - f).norm() / (1 + ligament.strain);
    const Eigen::Vector3d on_femur = femur.point(f), on_tibia = tibia.point(t);
    LineElement& element = model.elements.emplace_back();
    element.x_C = view.femur_moves ? on_tibia : on_femur;
    element.s_D = view.femur_moves ? on_femur : on_tibia;
    element.law = law;
    model.element_names.emplace_back(ligament.name);
  }
  const auto add_pair = [&](const char* name, const std::shared_ptr<const Surface>& condyle,
                            const std::shared_ptr<const Surface>& plateau) {
    ContactPair pair;
    pair.name = name;
    pair.on_B = view.femur_moves ? plateau : condyle;
    pair.on_A = view.femur_moves ? condyle : plateau;
    model.pairs.push_back(pair);
  };
  const double u = view.unit;
  add_pair("medial",
           make_ellipsoid(femur.point({-23, -2, 0}), femur.axes(exp_rotation({0.05, -0.03, 0.08})),
                          u * Eigen::Vector3d(19, 26, 24), true),
           make_sphere(tibia.point({-23, -4, 21}), u * 45, false));
  add_pair("lateral",
           make_ellipsoid(femur.point({23, -2, 0}), femur.axes(exp_rotation({-0.04, 0.02, -0.06})),
                          u * Eigen::Vector3d(18, 25, 23), true),
           make_plane(tibia.point({23, -2, -23.5}),
                      tibia.direction(Eigen::Vector3d(0.03, -0.07, 1).normalized())));
  JointFrames frames;
  frames.X_F = femur.transform();
  frames.X_T = tibia.transform();
  frames.tibia_moves = !view.femur_moves;
  frames.side = view.left ? -1 : 1;
  model.joint = frames;
  KinematicCondition flexion;
  flexion.kind = ConditionKind::kFlexion;
  flexion.frames = frames;
  model.conditions = {flexion};
  model.condition_names = {"flexion"};
  model.loads = {quadric_compression(view, tibia)};
  model.load_names = {"compression"};
  model.start = view.X;
  model.length = 30 * view.unit;
  return model;
}

}  // namespace condyle::test
