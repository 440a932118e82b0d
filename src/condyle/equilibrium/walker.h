#pragma once

/// From one solved pose to another along what is swept: the one way in which a sweep, the search
/// for events and the path of equilibria move the solver and describe where it stands.

#include "condyle/equilibrium/equilibrium_solver.h"

namespace condyle {

/// A pose with its state.
struct SolvedPose {
  double value = 0;
  PoseResult result;
  EquilibriumState state;  ///< where the pose is solved
};

class Walker {
 public:
  /// Refers to the solver. `drive`: of all that is not swept. Throws std::invalid_argument for a
  /// drive that is not one of the model.
  Walker(EquilibriumSolver& solver, const Swept& swept, const Drive& drive);

  [[nodiscard]] EquilibriumSolver& solver() { return solver_; }
  [[nodiscard]] const Model& model() const { return solver_.model(); }
  [[nodiscard]] const Swept& swept() const { return swept_; }
  /// What drives the model at a value; stays until the next call.
  const Drive& drive_at(double value);

  /// The next step goes from here.
  void stand_at(double value, const EquilibriumState& state);
  void stand_at(const SolvedPose& pose) { stand_at(pose.value, pose.state); }

  /// The pose at a value, from where the solver stands; true where it is one of equilibrium. Where
  /// it converged the solver stands there.
  bool step(double value, Patience patience, SolvedPose& to);

 private:
  EquilibriumSolver& solver_;
  Swept swept_;
  Drive drive_;
};

}  // namespace condyle
