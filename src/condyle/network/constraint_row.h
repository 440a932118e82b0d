#pragma once

/// The rows of a network's constraints: contacts along the common normal, ball joints, ports of
/// bodies whose motion is prescribed, and kinematic conditions.

#include "condyle/network/kinematics.h"
#include "condyle/network/settle_contacts.h"

namespace condyle {

/// One scalar constraint: d.(x_to - x_from) = rate, of the twists at two vertices.
struct ConstraintRow {
  int edge = -1;
  int vertex_to = 0, vertex_from = 0;
  Vector6 direction = Vector6::Zero();  ///< d
  double value = 0;                     ///< what has to vanish [mm] or [rad]
  double rate = 0;                      ///< what d.(x_to - x_from) has to be
  double acceleration = 0;              ///< and its rate
  /// How d.x changes where the body of either vertex is moved at a fixed twist: by turn.(motion of
  /// the reference port, rotation vector).
  Vector6 turn_to = Vector6::Zero(), turn_from = Vector6::Zero();
  double bias = 0;  ///< of the second derivative: all that is not J times acceleration
  int contact = -1, condition = -1;
};

[[nodiscard]] ConstraintRow contact_row(const Network& network,
                                        const NetworkGraph& graph,
                                        const Kinematics& at,
                                        const ContactLinearization& contact,
                                        std::size_t index);

/// All rows at a state: those of the closed contacts first.
void constraint_rows(const Network& network,
                     const NetworkGraph& graph,
                     const Kinematics& at,
                     const std::vector<SettledContact>& contacts,
                     const NetworkState& state,
                     std::vector<ConstraintRow>& rows);

}  // namespace condyle
