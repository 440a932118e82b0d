#pragma once

/// What one parameter (model_parameter.h) changes while the pose, the contact forces and the
/// multipliers stay: the rows of Newton's system, and the outputs that depend on it by themselves.
///
/// With the wrench w of 1 N of a line element, f(L) and v the motion of one of its ends:
///     a number of its law   ∂f w
///     an insertion          f ∂w/∂v + f' (∂L/∂v) w, and ∂f/∂l₀ (l₀/L_ref)(∂L_ref/∂v) w where the
///                           strain is held
/// A surface of B moved by u is a pose a - u seen from it, one of A a pose a + u whose moments are
/// taken about a: with the derivatives of the pair's wrench (contacts slide and roll),
///     of B: -F1 u, -M1 u, gap row -n.u      of A: F1 u, M1 u + u x f, gap row n.u.

#include <array>
#include <vector>

#include "condyle/contact/contact_scales.h"
#include "condyle/equilibrium/local_rates.h"
#include "condyle/equilibrium/model_parameter.h"

namespace condyle {

struct ParameterEffect {
  std::array<double, SmallLu::kMaxSize>
      column{};  ///< ∂residual, rows and signs of NewtonSystem::fill
  /// The line element that it belongs to, -1: none.
  int element = -1;
  double length = 0, force = 0, strain = 0;  ///< of that element [mm], [N], [-]
  /// Places of the closed contacts, ground frame [mm].
  std::array<Eigen::Vector3d, kMaxConstraints> points;
  /// By pairs: of those with a law of their own.
  struct Layer {
    Eigen::Vector3d f, m, resultant;  ///< on A [N], about O_A [N mm]; its place, ground frame [mm]
  };
  std::vector<Layer> layers;
};

/// `effect` is overwritten. Throws std::invalid_argument with one sentence where the model has no such
/// parameter, or a path or a law does not know. Allocates nothing once `effect` was used.
void find_effect(const ModelParameter& parameter, LocalRates& rates, ParameterEffect& effect);

}  // namespace condyle
