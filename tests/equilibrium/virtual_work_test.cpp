/// Energy, wrench and work agree, by differences, on a knee with every kind of load and with a law
/// and a load of one's own.

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "support/quadric_knee.h"
#include "support/random.h"

namespace condyle {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The quadric knee with a dead force, a dead and a follower moment, a spring to the ground as a
/// load of one's own, and an exponential law on one ligament.
Model loaded_knee() {
  Model model = test::quadric_knee();
  const auto add = [&model](const char* name, const Load& load) {
    model.loads.push_back(load);
    model.load_names.emplace_back(name);
  };
  Load drawer, moment, follower, spring;
  drawer.vector = {5, 20, -10};
  drawer.at = {0, 3, -40};
  moment.moment = follower.moment = true;
  moment.vector = {0, 300, 200};
  follower.vector = {100, 0, 400};
  follower.follows_body = true;
  spring.custom = [](const RigidTransform& X, Wrench& w) {  // energy 1/2 k |a - a0|²
    constexpr double k = 2;
    w.f -= k * (X.p - Eigen::Vector3d(3, -2, 1));
    w.F1 -= k * Eigen::Matrix3d::Identity();
  };
  add("drawer", drawer);
  add("moment", moment);
  add("follower", follower);
  add("spring", spring);
  CustomLaw law;
  law.tension = [](double length) {
    constexpr double c = 0.2, rest = 30, strength = 20;
    const double e = std::exp(c * (length - rest));
    return Tension{strength * (e - 1), strength * c * e,
                   strength * ((e - 1) / c - (length - rest))};
  };
  model.elements[0].law = law;
  return model;
}

double energy(const Model& model, const RigidTransform& X) {
  double sum = 0;
  for (const LineElement& element : model.elements) sum += line_element_state(element, X).energy;
  return sum;
}

RigidTransform moved(const RigidTransform& X, int direction, double step) {
  RigidTransform to = X;
  if (direction < 3) {
    to.p[direction] += step;
  } else {
    to.R = exp_rotation(step * Eigen::Vector3d::Unit(direction - 3)) * X.R;
  }
  return to;
}

Vector6 components(const Wrench& w) {
  Vector6 v;
  v << w.f, w.m;
  return v;
}

Eigen::Matrix<double, 6, 6> jacobian(const Wrench& w) {
  Eigen::Matrix<double, 6, 6> J;
  J << w.F1, w.F2, w.M1, w.M2;
  return J;
}

TEST(VirtualWork, TheWrenchOfLigamentsIsTheNegativeGradientOfTheirEnergy) {
  const Model model = loaded_knee();
  test::Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    RigidTransform X = random.pose(3);
    X.R = exp_rotation(0.4 * random.vector(1));
    Wrench wrench;
    for (const LineElement& element : model.elements) add_line_element(element, X, wrench);
    for (int i = 0; i < 6; ++i) {
      const double h = i < 3 ? 1e-4 : 1e-6;
      const double slope =
          (energy(model, moved(X, i, h)) - energy(model, moved(X, i, -h))) / (2 * h);
      EXPECT_NEAR(components(wrench)[i], -slope, 1e-6 * (1 + std::abs(slope)));
    }
  }
}

TEST(VirtualWork, DerivativesOfTheWholeWrenchAreThoseOfDifferences) {
  const Model model = loaded_knee();
  test::Random random(12);
  const auto wrench_at = [&model](const RigidTransform& X) {
    Wrench wrench;
    for (const LineElement& element : model.elements) add_line_element(element, X, wrench);
    for (const Load& load : model.loads) add_load(load, load.scale, X, wrench);
    return wrench;
  };
  for (int trial = 0; trial < 20; ++trial) {
    RigidTransform X = random.pose(3);
    X.R = exp_rotation(0.4 * random.vector(1));
    const Eigen::Matrix<double, 6, 6> J = jacobian(wrench_at(X));
    for (int i = 0; i < 6; ++i) {
      const double h = i < 3 ? 1e-5 : 1e-7;
      const Vector6 slope =
          (components(wrench_at(moved(X, i, h))) - components(wrench_at(moved(X, i, -h)))) /
          (2 * h);
      EXPECT_LT((J.col(i) - slope).norm(), 1e-6 * (100 + slope.norm())) << "direction " << i;
    }
  }
}

// Along the path of equilibria contacts do no work: what flexion takes is what the energy of the
// ligaments gains, less what the loads do.
TEST(VirtualWork, TheFlexionMomentIsTheSlopeOfTheEnergyLessTheWorkOfTheLoads) {
  EquilibriumSolver solver(loaded_knee());
  for (const double flexion : {0.2, 0.7, 1.2}) {
    constexpr double kStep = 1e-4;
    const auto pose_at = [&solver](double angle) {
      return solver.solve(condition_value(0).with(drive_of(solver.model()), angle));
    };
    const PoseResult before = pose_at(flexion - kStep), pose = pose_at(flexion),
                     after = pose_at(flexion + kStep);
    ASSERT_TRUE(before.converged() && pose.converged() && after.converged()) << pose.reason;
    const Model& model = solver.model();
    Wrench loads;
    for (const Load& load : model.loads) add_load(load, load.scale, pose.X_BA, loads);
    const Eigen::Vector3d turn = log_rotation(after.X_BA.R * before.X_BA.R.transpose());
    const double work = loads.f.dot(after.X_BA.p - before.X_BA.p) + loads.m.dot(turn);
    const double gain = energy(model, after.X_BA) - energy(model, before.X_BA);
    EXPECT_NEAR(-pose.conditions[0].multiplier, (gain - work) / (2 * kStep), 1e-2) << flexion;
    EXPECT_GT(std::abs(pose.conditions[0].multiplier), 100) << flexion;
  }
}

}  // namespace
}  // namespace condyle
