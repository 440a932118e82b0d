#pragma once

/// Ways to solve the equations of the quadric knee, to set beside ours.

#include <array>
#include <string>
#include <vector>

#include "accuracy/knee_equations.h"

namespace condyle::accuracy {

struct PeerResult {
  Unknowns<double> x;
  int iterations = 0;
  bool converged = false;
};

struct Peer {
  std::string name;
  PeerResult (*solve)(const KneeEquations&, const Unknowns<double>& start);
};

/// Plain and damped Newton, and KINSOL and Ceres where they were found when this was built.
[[nodiscard]] std::vector<Peer> peers();

/// A pose in long double.
struct ExactPose {
  Vec3<long double> a;
  Mat3<long double> R;
  std::array<long double, 2> contacts;  ///< their forces [N]
  double residual = 0;                  ///< largest of the equations' [N] or [mm]
};

/// The solution in long double, from one in double.
[[nodiscard]] ExactPose solve_exactly(const KneeEquations& equations, const Unknowns<double>& near);

/// An equilibrium of the engine as unknowns of the equations, whose R0 becomes its rotation.
[[nodiscard]] Unknowns<double> unknowns_of(const EquilibriumState& state,
                                           const NewtonSystem& system,
                                           KneeEquations& equations);

/// Largest of |Δa|/L and the angle between the rotations [rad].
[[nodiscard]] double pose_error(const ExactPose& truth, const RigidTransform& X, double L);

/// Largest error of the forces of contacts and ligaments [N].
[[nodiscard]] double force_error(const KneeEquations& equations,
                                 const ExactPose& truth,
                                 const RigidTransform& X,
                                 const std::array<double, 2>& contacts);

/// The pose that unknowns stand for, and the forces of its contacts.
[[nodiscard]] RigidTransform pose_of(const KneeEquations& equations, const Unknowns<double>& x);
[[nodiscard]] std::array<double, 2> contact_forces(const Unknowns<double>& x);
[[nodiscard]] std::array<double, 2> contact_forces(const EquilibriumState& state);

}  // namespace condyle::accuracy
