#pragma once

/// The twelve-spring knee with spheres on planes of Abdel-Rahman and Hefzy 1998, for tests. Its
/// numbers are recalled from the literature and cross-checked, not read from a printed table.

#include "condyle/equilibrium/model.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle::test {

/// Femur fixed, tibia moving, flexion prescribed; the whole scene turned by X (femur side) where
/// one is given.
inline Model spring_knee(const RigidTransform& X = {}) {
  struct Spring {
    const char* name;
    double femur[3], tibia[3], k1, k2;
  };
  constexpr Spring kSprings[] = {{"aACL", {7.25, -15.6, 21.25}, {-7, 5, 211.25}, 22.48, 83.15},
                                 {"pACL", {7.25, -20.3, 19.55}, {2, 2, 212.25}, 26.27, 83.15},
                                 {"aPCL", {-4.75, -11.2, 14.05}, {5, -30, 206.25}, 31.26, 125},
                                 {"pPCL", {-4.75, -23.2, 15.65}, {-5, -30, 206.25}, 19.29, 60},
                                 {"aMCL", {-34.75, -1, 26.25}, {-20, 4, 171.25}, 10, 91.25},
                                 {"oMCL", {-34.75, -8, 24.25}, {-35, -30, 199.25}, 5, 27.86},
                                 {"dMCL", {-34.75, -5, 21.25}, {-35, 0, 199.25}, 5, 21.07},
                                 {"LCL", {35.25, -15, 21.25}, {45, -25, 176.25}, 10, 72.22},
                                 {"mCAP", {-24.75, -38, 6.25}, {-25, -25, 181.25}, 12, 52.59},
                                 {"lCAP", {25.25, -35.5, 12.25}, {25, -25, 181.25}, 12, 54.62},
                                 {"OPL", {25.25, -35.5, 12.25}, {-25, -25, 181.25}, 3, 21.42},
                                 {"APL", {-24.75, -38, 6.25}, {25, -25, 181.25}, 3, 20.82}};
  Model model;
  for (const Spring& spring : kSprings) {
    // F = K1 (L - L0)², then K2 (L - 1.03 L0): the toe-linear law with k = K2 L0, L0 = K2/(0.12
    // K1).
    ToeLinearLaw law;
    law.slack_length = spring.k2 / (0.12 * spring.k1);
    law.stiffness = spring.k2 * law.slack_length;
    model.elements.push_back(
        {X * Eigen::Vector3d(spring.femur), Eigen::Vector3d(spring.tibia), law});
    model.element_names.emplace_back(spring.name);
  }
  const auto add_pair = [&](const char* name, const Eigen::Vector3d& center, double radius,
                            double m, double c) {
    ContactPair pair;
    pair.name = name;
    pair.on_B = make_sphere(X * center, radius, true);
    pair.on_A = make_plane({0, 0, c}, Eigen::Vector3d(-m, 0, 1).normalized());
    model.pairs.push_back(pair);
  };
  add_pair("medial", {-23.75, -18, 12}, 21, 0.358, 213.0);
  add_pair("lateral", {23, -16, 11.5}, 20, -0.341, 212.9);
  JointFrames frames;
  frames.X_F = X;
  model.joint = frames;
  KinematicCondition flexion;
  flexion.kind = ConditionKind::kFlexion;
  flexion.frames = frames;
  model.conditions = {flexion};
  model.condition_names = {"flexion"};
  model.start = X * RigidTransform{Eigen::Matrix3d::Identity(), {2.3, -7, -215.1}};
  model.length = 30;
  return model;
}

}  // namespace condyle::test
