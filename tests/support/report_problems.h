#pragma once

/// The problems of chapter 4 of [Dortmans 1986] with their exact answers, for tests
/// (docs/dortmans.md). Units of the report: cm and N; the solver does not mind.

#include <cmath>

#include "condyle/equilibrium/model.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle::test {

inline ForceLaw polynomial(std::vector<double> coefficients) {
  return PolynomialLaw{std::move(coefficients), false};
}

/// Sphere of radius 1 inside a cylinder of radius 2 about z, four elements, z-translation phi
/// prescribed.
struct Problem1 {
  static constexpr double a = 2, b = 1, s1 = 5, s3 = 6, A = 1, B = 2;

  static Model model(double phi, double pull_off = 0) {
    Model model;
    const ForceLaw law = polynomial({0, A, B});
    for (const double y : {b, -b}) model.elements.push_back({{a, 0, s1}, {0, y, 0}, law});
    model.elements.push_back({{a, 0, s3}, {b, 0, 0}, law});
    model.element_names = {"1", "2", "3"};
    Load weight;
    weight.vector = {0, 0, -50};
    Load pull;
    pull.vector = {-pull_off, 0, 0};
    model.loads = {weight, pull};
    model.load_names = {"weight", "pull"};
    KinematicCondition height;
    height.kind = ConditionKind::kTranslation;
    height.axis = Eigen::Vector3d::UnitZ();
    height.value = phi;
    model.conditions = {height};
    model.condition_names = {"height"};
    ContactPair pair;
    pair.name = "wall";
    pair.on_B = make_cylinder(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), a, false);
    pair.on_A = make_sphere(Eigen::Vector3d::Zero(), b, true);
    model.pairs = {pair};
    model.start.p = {a - b, 0, phi};
    model.length = 1;
    return model;
  }

  // tan w = (phi - s3)/b, w < 0 the stable branch.
  static double w(double phi) { return std::atan((phi - s3) / b); }
  static double L1(double phi) { return std::sqrt(2 * b * b + (phi - s1) * (phi - s1)); }
  static double L3(double phi) {
    return std::hypot(b * std::cos(w(phi)) - b, phi - s3 - b * std::sin(w(phi)));
  }
  static double p(double phi) {
    return 2 * (A + B * L1(phi)) * b + (A + B * L3(phi)) * (b - b * std::cos(w(phi)));
  }
  static double sigma(double phi) {
    return -50 + 2 * (A + B * L1(phi)) * (s1 - phi) +
           (A + B * L3(phi)) * (s3 - phi + b * std::sin(w(phi)));
  }
};

/// Six elements from a frame to the poles of a unit sphere, no contact, dead weight 4 N.
inline Model six_elements(double slack_of_first) {
  constexpr double a = 2, b = 1;
  Model model;
  const auto add = [&](const Eigen::Vector3d& x_C, const Eigen::Vector3d& s_D, double slack) {
    model.elements.push_back({x_C, s_D, polynomial({-slack, 1})});
    model.element_names.push_back(std::to_string(model.elements.size()));
  };
  add({a, 0, 3}, {b, 0, 0}, slack_of_first);
  add({-a, 0, 3}, {-b, 0, 0}, 0);
  add({0, a, 3}, {0, b, 0}, 0);
  add({0, -a, 3}, {0, -b, 0}, 0);
  add({0, 0, 6}, {0, 0, b}, 0);
  add({0, 0, 0}, {0, 0, -b}, 0);
  Load weight;
  weight.vector = {0, 0, -4};
  model.loads = {weight};
  model.load_names = {"weight"};
  model.start.p = {0, 0, 3};
  model.length = 1;
  return model;
}

}  // namespace condyle::test
