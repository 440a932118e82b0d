/// Rows of constraints where the bodies are moved a little: tangents against differences.

#include "condyle/network/constraint_row.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/math/rotation.h"
#include "condyle/network/knee_network.h"
#include "condyle/network/network_equations.h"
#include "condyle/network/project.h"
#include "support/leg.h"
#include "support/quadric_knee.h"
#include "support/random.h"

namespace condyle {
namespace {

/// Two closed contacts and a flexion condition, moving at random.
struct MovingKnee {
  Model model = test::quadric_knee();
  KneeNetwork knee = make_knee_network(model, test::leg());
  NetworkState state;

  MovingKnee() {
    EquilibriumSolver solver(model);
    EXPECT_TRUE(solver.solve().converged());
    state = state_at_rest(model, cover_pairs(model), knee, solver.state());
    test::Random random(17);
    state.bodies[0].v = random.vector(200);
    state.bodies[0].omega = random.vector(3);
  }
};

NetworkState moved(NetworkState state, const Vector6& d, const Eigen::Vector3d& reference) {
  RigidTransform& X = state.bodies[0].X;
  const Eigen::Vector3d at = X * reference + d.head<3>();
  X.R = exp_rotation(d.tail<3>()) * X.R;
  X.p = at - X.R * reference;
  return state;
}

// J x and the values by their tangents, and by assembling there: what is left is quadratic.
TEST(ConstraintRow, TurnsAsItsBodyMoves) {
  const MovingKnee at;
  test::Random random(5);
  Vector6 direction;
  direction << random.vector(1), random.vector(0.02);
  double before = 0;
  for (const double h : {1e-2, 1e-3, 1e-4}) {
    NetworkEquations here(at.knee.network), there(at.knee.network);
    NetworkState state = at.state, other = moved(at.state, h * direction, test::leg().center);
    ASSERT_TRUE(here.assemble(state) && there.assemble(other));
    ASSERT_EQ(here.rows().size(), there.rows().size());
    ASSERT_GE(here.rows().size(), 3U);
    const Vector6 x = here.kinematics().twist(0);
    double off = 0;
    for (std::size_t k = 0; k < here.rows().size(); ++k) {
      const ConstraintRow &row = here.rows()[k], &next = there.rows()[k];
      const auto index = static_cast<Eigen::Index>(k);
      const double value = row.value + h * here.jacobian().row(index).dot(direction);
      const double rate = here.jacobian().row(index).dot(x) + h * row.turn_to.dot(direction);
      off = std::max(
          {off, std::abs(next.value - value), std::abs(there.jacobian().row(index).dot(x) - rate)});
    }
    if (before > 0) {
      EXPECT_LT(off, 0.02 * before);
    }
    before = off;
  }
}

// A state a little off is put on its constraints without assembling, as well as with it.
TEST(ConstraintRow, NearbyStatesAreProjectedAlongTheTangents) {
  const MovingKnee at;
  NetworkEquations equations(at.knee.network);
  NetworkState state = at.state;
  ASSERT_TRUE(project(equations, state));
  test::Random random(6);
  Vector6 direction;
  direction << random.vector(1e-5), random.vector(1e-7);
  NetworkState off = moved(state, direction, test::leg().center);
  off.bodies[0].v += random.vector(1e-3);
  ASSERT_TRUE(equations.assemble(state));
  ASSERT_TRUE(project_nearby(equations, 1e-9, off));
  EXPECT_FALSE(is_nearby(equations, 1e-14, off));
  ASSERT_TRUE(equations.assemble(off));
  for (const ConstraintRow& row : equations.rows()) EXPECT_LT(std::abs(row.value), 1e-11);
  EXPECT_LT(equations.velocity_correction().norm(), 1e-9);
  NetworkState far = moved(state, 1e3 * direction, test::leg().center);
  const Eigen::Vector3d p = far.bodies[0].X.p;
  ASSERT_TRUE(equations.assemble(state));
  EXPECT_FALSE(project_nearby(equations, 1e-9, far));
  EXPECT_EQ(far.bodies[0].X.p, p);
}

}  // namespace
}  // namespace condyle
