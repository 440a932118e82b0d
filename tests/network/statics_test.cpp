/// With the inertia left out, the network is the engine.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/math/rotation.h"
#include "condyle/network/knee_network.h"
#include "condyle/network/network_equations.h"
#include "condyle/network/settle_contacts.h"
#include "support/led_paths.h"
#include "support/quadric_knee.h"
#include "support/random.h"

namespace condyle {
namespace {

/// w - Jᵀ μ of the network about O_A, the contact forces and multipliers being the engine's.
Vector6 network_balance(const Model& model, const EquilibriumState& state) {
  const KneeNetwork knee = make_knee_network(model, {});
  NetworkEquations equations(knee.network);
  NetworkState at = state_at_rest(model, cover_pairs(model), knee, state);
  EXPECT_TRUE(equations.assemble(at));
  Eigen::VectorXd mu(static_cast<Eigen::Index>(equations.rows().size()));
  for (std::size_t k = 0; k < equations.rows().size(); ++k) {
    const ConstraintRow& row = equations.rows()[k];
    double& value = mu[static_cast<Eigen::Index>(k)];
    if (row.condition >= 0) value = state.sigma[row.condition];
    for (const ClosedContact& contact : state.contacts)
      if (row.contact >= 0 && knee.places[row.contact] == contact.pair) value = -contact.p;
  }
  return equations.wrenches() - equations.jacobian().transpose() * mu;
}

/// Two contacts of eight ligaments at random poses near extension, forces and multipliers random.
TEST(Statics, NetworkWithoutInertiaHasTheEnginesResidual) {
  test::Random random(31);
  const Model model = test::quadric_knee();
  EquilibriumSolver solver(model);
  ASSERT_TRUE(solver.solve().converged());
  const EquilibriumState rest = solver.state();
  ASSERT_EQ(rest.contacts.size(), 2U);
  for (int trial = 0; trial < 20; ++trial) {
    EquilibriumState state = rest;
    state.X.R = exp_rotation(random.vector(0.1)) * state.X.R;
    state.X.p += random.vector(2);
    for (ClosedContact& contact : state.contacts) contact.p = random.between(0, 400);
    state.sigma[0] = random.between(-2e4, 2e4);
    // Both look at the contact points of this pose.
    const KneeNetwork knee = make_knee_network(model, {});
    NetworkState at = state_at_rest(model, cover_pairs(model), knee, state);
    std::vector<SettledContact> settled;
    ASSERT_TRUE(settle_contacts(knee.network, true, at, settled));
    for (std::size_t i = 0; i < knee.places.size(); ++i)
      for (ClosedContact& contact : state.contacts)
        if (at.contacts[i].closed && contact.pair == knee.places[i]) {
          contact.places = at.contacts[i].places;
        }
    NewtonSystem system(model);
    ASSERT_TRUE(system.assemble(state, drive_of(model)));
    const Vector6 balance = network_balance(model, state);
    const double scale = system.force_scale(), L = model.length;
    EXPECT_LT((balance.head<3>() - system.wrench().f).norm(), 1e-12 * scale);
    EXPECT_LT((balance.tail<3>() - system.wrench().m).norm(), 1e-12 * scale * L);
    EXPECT_GT(system.out_of_balance(), 1);
  }
}

// At the engine's pose both vanish.
TEST(Statics, TheEnginesPoseIsAPositionOfRestOfTheNetwork) {
  const Model model = test::quadric_knee();
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged());
  const Vector6 balance = network_balance(model, solver.state());
  EXPECT_LT(balance.head<3>().norm(), 1e-9);
  EXPECT_LT(balance.tail<3>().norm(), 1e-9 * model.length);

  // With mass, and no gravity, it has no acceleration and the multipliers are the engine's.
  MassProperties mass;
  mass.mass = 4e-3;
  mass.center = {0, 0, -180};
  mass.inertia = Eigen::Vector3d(50, 50, 8).asDiagonal();
  const KneeNetwork knee = make_knee_network(model, mass);
  NetworkEquations equations(knee.network);
  NetworkState state = state_at_rest(model, cover_pairs(model), knee, solver.state());
  ASSERT_TRUE(equations.assemble(state) && equations.solve());
  EXPECT_LT(equations.accelerations().norm(), 1e-5);  // 1e-9 N on 4e-6 N s²/mm
  int closed = 0;
  for (std::size_t i = 0; i < knee.places.size(); ++i) {
    if (!state.contacts[i].closed) continue;
    EXPECT_NEAR(equations.contact_force(i), pose.contacts[knee.places[i]].force, 1e-8);
    ++closed;
  }
  EXPECT_EQ(closed, 2);
}

// The position of rest of a knee whose ligaments go through pegs, and no longer that of straight ones.
TEST(Statics, ALineWithAPathOfItsOwnPullsAsInTheEngine) {
  Model led = test::quadric_knee();
  for (const std::size_t i : {1U, 4U}) {
    const Eigen::Vector3d middle = 0.5 * (led.elements[i].x_C + led.start * led.elements[i].s_D);
    led.elements[i].path = std::make_shared<test::PegPath>(middle + Eigen::Vector3d(0.3, 0.2, 0.1));
  }
  EquilibriumSolver solver(led);
  ASSERT_TRUE(solver.solve().converged());
  const Vector6 balance = network_balance(led, solver.state());
  EXPECT_LT(balance.head<3>().norm(), 1e-9);
  EXPECT_LT(balance.tail<3>().norm(), 1e-9 * led.length);
  const Vector6 straight = network_balance(test::quadric_knee(), solver.state());
  EXPECT_GT(straight.norm(), 1e-3);
}

// The rate of a line's length is that of the pose.
TEST(Statics, TheRateOfAPathIsItsDerivativeAlongTheMotion) {
  Model led = test::quadric_knee();
  led.elements[1].path = std::make_shared<test::PegPath>(Eigen::Vector3d(3, -8, 5));
  EquilibriumSolver solver(led);
  ASSERT_TRUE(solver.solve().converged());
  const KneeNetwork knee = make_knee_network(led, {});
  const NetworkState rest = state_at_rest(led, cover_pairs(led), knee, solver.state());
  const Eigen::Vector3d v(3, -5, 2), omega(0.2, 0.1, -0.3);
  const auto line_at = [&](double t) {
    NetworkState state = rest;
    BodyState& body = state.bodies[0];
    body.X.R = exp_rotation(t * omega) * body.X.R;
    body.X.p += t * v;
    body.v = v;
    body.omega = omega;
    NetworkEquations equations(knee.network);
    EXPECT_TRUE(equations.assemble(state));
    return equations.lines()[1];
  };
  constexpr double h = 1e-5;
  const double difference = (line_at(h).length - line_at(-h).length) / (2 * h);
  EXPECT_NEAR(line_at(0).rate, difference, 1e-7 * std::abs(difference));
}

}  // namespace
}  // namespace condyle
