#include "condyle/network/project.h"

#include <Eigen/Geometry>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

void move(const Network& network, const Eigen::VectorXd& step, NetworkState& state) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const Vector6 d = step.segment<6>(static_cast<Eigen::Index>(6 * b));
    RigidTransform& X = state.bodies[b].X;
    const Eigen::Vector3d reference = X * network.bodies[b].reference + d.head<3>();
    X.R = orthonormalized(exp_rotation(d.tail<3>()) * X.R);
    X.p = reference - X.R * network.bodies[b].reference;
  }
}

double largest_value(const NetworkEquations& equations) {
  double largest = 0;
  for (const ConstraintRow& row : equations.rows())
    largest = std::max(largest, std::abs(row.value));
  return largest;
}

/// Surfaces and joints of a knee depart from their tangents by d²/2r, r no less than a third of L.
bool is_small(const Eigen::VectorXd& moved, double remainder, double L) {
  const double least_radius = L / 3, lever = 10 * L / 3;
  for (Eigen::Index row = 0; row < moved.size(); row += 6) {
    const double square = moved.segment<3>(row).squaredNorm() +
                          lever * lever * moved.segment<3>(row + 3).squaredNorm();
    if (!(square < 2 * least_radius * remainder)) return false;
  }
  return true;
}

Eigen::VectorXd twists_of(const NetworkState& state) {
  Eigen::VectorXd twists(static_cast<Eigen::Index>(6 * state.bodies.size()));
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    twists.segment<6>(static_cast<Eigen::Index>(6 * b)) << state.bodies[b].v, state.bodies[b].omega;
  return twists;
}

}  // namespace

void add_twists(NetworkState& state, const Eigen::VectorXd& change) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    state.bodies[b].v += change.segment<3>(row);
    state.bodies[b].omega += change.segment<3>(row + 3);
  }
}

bool is_nearby(const NetworkEquations& equations, double remainder, const NetworkState& state) {
  Eigen::VectorXd moved;
  equations.kinematics().displacement(state, moved);
  return is_small(moved, remainder, equations.network().length);
}

bool project_nearby(const NetworkEquations& equations, double remainder, NetworkState& state) {
  Eigen::VectorXd moved;
  equations.kinematics().displacement(state, moved);
  if (!is_small(moved, remainder, equations.network().length)) return false;
  const Eigen::VectorXd step = equations.position_correction_after(moved);
  moved += step;
  if (!is_small(moved, remainder, equations.network().length)) return false;
  const Eigen::VectorXd change = equations.velocity_correction_after(moved, twists_of(state));
  if (!change.allFinite()) return false;
  move(equations.network(), step, state);
  add_twists(state, change);
  return true;
}

bool project(NetworkEquations& equations, NetworkState& state) {
  constexpr double kNearby = 1e-12 / 30;  // of L: a step from there is exact to round-off
  const double nearby = kNearby * equations.network().length;
  constexpr int kMostSteps = 10;
  for (int step = 0; step < kMostSteps; ++step) {
    if (!equations.assemble(state)) return false;
    if (project_nearby(equations, nearby, state)) return true;
    if (!(largest_value(equations) > 0)) return false;
    move(equations.network(), equations.position_correction(), state);
  }
  return false;
}

}  // namespace condyle
