#include <Eigen/Geometry>

#include "math/rotation.h"
#include "network/integrate.h"

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

}  // namespace

void add_twists(NetworkState& state, const Eigen::VectorXd& change) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    state.bodies[b].v += change.segment<3>(row);
    state.bodies[b].omega += change.segment<3>(row + 3);
  }
}

bool project(NetworkEquations& equations, NetworkState& state) {
  constexpr double kSettled = 1e-8;  // [mm], [rad]; a step from there is exact to round-off
  constexpr int kMostSteps = 10;
  for (int step = 0;; ++step) {
    if (!equations.assemble(state)) return false;
    if (step == kMostSteps) return false;
    const double value = largest_value(equations);
    if (value > 0) move(equations.network(), equations.position_correction(), state);
    if (value < kSettled) break;
  }
  const Eigen::VectorXd change = equations.velocity_correction();
  add_twists(state, change);
  return change.allFinite();
}

}  // namespace condyle
