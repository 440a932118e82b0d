#pragma once

/// Two springs that meet in a flat apex which a load presses down (the truss of von Mises), with
/// its closed form, for tests of snap-through.

#include <cmath>

#include "condyle/equilibrium/model.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle::test {

/// Springs f = k (L - l0) from (±a, 0, 0) to A's origin at height z; the load is P downwards, P its
/// scale. Everything but z is held. Without force at z = h.
struct Truss {
  static constexpr double a = 10, h = 5, k = 20;

  static double l0() { return std::hypot(a, h); }
  /// The load at a height: P = 2 k z (l0/L - 1).
  static double load(double z) { return 2 * k * z * (l0() / std::hypot(a, z) - 1); }
  /// dP/dz = 0 where L³ = l0 a².
  static double limit_height() { return std::sqrt(std::pow(l0() * a * a, 2.0 / 3) - a * a); }
  static double limit_load() { return load(limit_height()); }

  static Model model() {
    Model model;
    for (const double side : {-1.0, 1.0}) {
      LineElement& spring = model.elements.emplace_back();
      spring.x_C = {side * a, 0, 0};
      spring.s_D = {0, 0, 0};
      spring.law = PolynomialLaw{{-k * l0(), k}, false};
      model.element_names.emplace_back(side < 0 ? "left" : "right");
    }
    Load press;
    press.vector = {0, 0, -1};
    press.scale = 0;
    model.loads = {press};
    model.load_names = {"press"};
    for (int i = 0; i < 5; ++i) {
      KinematicCondition hold;
      hold.kind = i < 2 ? ConditionKind::kTranslation : ConditionKind::kRotation;
      hold.axis = Eigen::Vector3d::Unit(i % 2);
      hold.cardan_axis = i < 2 ? 0 : i - 2;
      model.conditions.push_back(hold);
      model.condition_names.push_back("hold " + std::to_string(i));
    }
    model.start.p = {0, 0, h};
    model.length = a;
    return model;
  }

  /// With a ball of radius 1 about the apex that meets a floor at z = -8.
  static Model with_floor() {
    Model truss = model();
    ContactPair floor;
    floor.name = "floor";
    floor.on_B = make_plane({0, 0, -8}, {0, 0, 1});
    floor.on_A = make_sphere({0, 0, 0}, 1, true);
    truss.pairs = {floor};
    return truss;
  }
};

}  // namespace condyle::test
