#pragma once

/// A state with its drive and the system that was assembled there: what the first derivatives at a
/// pose know, in one piece. Stability, joint stiffness, dependence, the path and the report take it.

#include <string>

#include "condyle/equilibrium/newton.h"

namespace condyle {

/// Refers to what it is made of; valid until one of them changes.
struct Linearization {
  const Model& model;
  const EquilibriumState& state;
  const Drive& drive;
  const NewtonSystem& system;

  [[nodiscard]] const Wrench& wrench() const { return system.wrench(); }
  [[nodiscard]] const std::vector<ContactLinearization>& contacts() const {
    return system.contacts();
  }
  [[nodiscard]] const std::vector<ConditionDerivatives>& conditions() const {
    return system.conditions();
  }
  [[nodiscard]] double force_scale() const { return system.force_scale(); }
  /// The pair that a closed contact belongs to.
  [[nodiscard]] const ContactPair& pair(std::size_t contact) const {
    return model.pairs[static_cast<std::size_t>(state.contacts[contact].pair)];
  }
  /// Contacts and conditions; contacts come first.
  [[nodiscard]] std::size_t constraints() const { return contacts().size() + conditions().size(); }
};

/// Throws std::invalid_argument where the system was last assembled at another state.
[[nodiscard]] Linearization linearization(const NewtonSystem& system,
                                          const EquilibriumState& state,
                                          const Drive& drive);

/// How the rows of Newton's system change with a number of the drive at a fixed state: those of
/// NewtonSystem::fill with its signs, 6 + n + m of them. Throws std::out_of_range for a number that
/// the drive has not.
void fill_drive_column(const Linearization& at, const Swept& swept, double* column);

}  // namespace condyle
