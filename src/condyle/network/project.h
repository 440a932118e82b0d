#pragma once

/// States put onto their constraints.

#include "condyle/network/network_equations.h"

namespace condyle {

/// Adds six numbers for each body to its twist.
void add_twists(NetworkState& state, const Eigen::VectorXd& change);

/// Puts a state onto its constraints, pose and twists. False where that does not settle.
bool project(NetworkEquations& equations, NetworkState& state);

/// The same for a state near the one that the equations were assembled at: by their rows as they
/// are, without assembling. What is quadratic in the difference is left, in the pose less than
/// `remainder` [mm]; false, and nothing is done, where it may be more.
bool project_nearby(const NetworkEquations& equations, double remainder, NetworkState& state);

/// Does a state differ so little from the one assembled?
bool is_nearby(const NetworkEquations& equations, double remainder, const NetworkState& state);

}  // namespace condyle
