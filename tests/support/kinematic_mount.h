#pragma once

/// A body that stands with one to six contacts: three balls, each in a groove of two walls
/// (Kelvin's clamp), with a weight and springs that hold what the contacts leave free.

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/equilibrium/model.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle::test {

/// Loads: the weight, 100 N, and a side load of 5 N.
inline Model kinematic_mount(int contacts) {
  using Eigen::Vector3d;
  constexpr double kRadius = 5, kArm = 30;
  Model model;
  for (int k = 0; k < contacts; ++k) {
    // The first three contacts are of three balls, so that few of them stand as well.
    const int ball = k % 3, wall = k / 3;
    const double angle = 2 * M_PI * ball / 3;
    const Vector3d out(std::cos(angle), std::sin(angle), 0), along(-out.y(), out.x(), 0);
    const Vector3d normal = (Vector3d::UnitZ() + (wall == 0 ? 1 : -1) * along).normalized();
    ContactPair pair;
    pair.name = "contact " + std::to_string(k + 1);
    pair.on_B = make_plane(kArm * out - kRadius * normal, normal);
    pair.on_A = make_sphere(kArm * out, kRadius, true);
    model.pairs.push_back(pair);
  }
  for (int k = 0; k < 6; ++k) {
    const double angle = M_PI * k / 3;
    const Vector3d out(std::cos(angle), std::sin(angle), 0);
    LineElement spring;
    spring.x_C = 60 * out + Vector3d(0, 0, k % 2 == 0 ? 20 : -40);
    spring.s_D = 20 * out + Vector3d(0, 0, k % 3 == 0 ? 10 : 0);
    spring.law = ToeLinearLaw{2000, 0.06, 0.9 * (spring.x_C - spring.s_D).norm()};
    model.elements.push_back(spring);
    model.element_names.push_back("spring");
  }
  Load weight, side;
  weight.vector = {0, 0, -100};
  side.vector = {5, 3, 0};
  side.at = {0, 0, 5};
  side.scale = 0;
  model.loads = {weight, side};
  model.load_names = {"weight", "side"};
  return model;
}

inline int closed_contacts(const PoseResult& pose) {
  int closed = 0;
  for (const ContactResult& contact : pose.contacts)
    closed += static_cast<int>(contact.closed ? contact.points.size() : 0);
  return closed;
}

}  // namespace condyle::test
