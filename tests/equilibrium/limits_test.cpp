/// What ends a search, and what keeps a pose without numbers from being called converged.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/newton.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/math/degree.h"
#include "support/layered_pairs.h"
#include "support/quadric_knee.h"

namespace condyle {
namespace {

PoseResult pose_with_one_of_each() {
  PoseResult pose;
  pose.X_BA = RigidTransform();
  pose.contacts.resize(1);
  pose.contacts[0].closed = true;
  pose.contacts[0].points.resize(1);
  pose.contacts[0].points[0].point_ground.setZero();
  pose.contacts[0].resultant_ground.setZero();
  pose.ligaments.resize(1);
  pose.conditions.resize(1);
  return pose;
}

TEST(FiniteNumbers, AnyThatIsNoneIsSeen) {
  ASSERT_TRUE(has_finite_numbers(pose_with_one_of_each()));
  const std::vector<std::function<double&(PoseResult&)>> numbers = {
      [](PoseResult& p) -> double& { return p.X_BA.p.y(); },
      [](PoseResult& p) -> double& { return p.X_BA.R(2, 1); },
      [](PoseResult& p) -> double& { return p.joint.flexion; },
      [](PoseResult& p) -> double& { return p.joint.distraction; },
      [](PoseResult& p) -> double& { return p.contacts[0].force; },
      [](PoseResult& p) -> double& { return p.contacts[0].resultant_ground.x(); },
      [](PoseResult& p) -> double& { return p.contacts[0].points[0].gap; },
      [](PoseResult& p) -> double& { return p.contacts[0].points[0].point_ground.z(); },
      [](PoseResult& p) -> double& { return p.ligaments[0].length; },
      [](PoseResult& p) -> double& { return p.ligaments[0].strain; },
      [](PoseResult& p) -> double& { return p.ligaments[0].force; },
      [](PoseResult& p) -> double& { return p.conditions[0].multiplier; }};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (const double none :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      PoseResult pose = pose_with_one_of_each();
      numbers[i](pose) = none;
      EXPECT_FALSE(has_finite_numbers(pose)) << i;
    }
  // What an open contact has for a resultant may be nothing.
  PoseResult open = pose_with_one_of_each();
  open.contacts[0].closed = false;
  open.contacts[0].resultant_ground.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(has_finite_numbers(open));
}

/// A knee at 35 degrees, and a start a hundredth of a millimetre or three away from its equilibrium.
struct DisplacedKnee {
  explicit DisplacedKnee(Model knee) : model(std::move(knee)) {
    model.conditions[0].value = 35 * kDegree;
    EquilibriumSolver solver(model);
    const PoseResult expected = solver.solve();
    EXPECT_TRUE(expected.converged()) << expected.reason;
    start.X = expected.X_BA;
    start.X.p += Eigen::Vector3d(0.02, -0.01, 0.03);
    start.sigma.assign(model.conditions.size(), 0);
  }
  NewtonReport solve(Newton& newton) const {
    EquilibriumState state = start;
    return newton.solve(state, drive_of(model));
  }
  Model model;
  EquilibriumState start;
};

// Contact laws that look at fields of points may cost 20 ms an iteration: their points end a solve as iterations do.
TEST(BoundedLaws, EndASolveAsIterationsDo) {
  const DisplacedKnee knee(test::on_layers(test::quadric_knee()));
  Newton newton(knee.model);
  const NewtonReport free = knee.solve(newton);
  ASSERT_EQ(free.outcome, NewtonOutcome::kConverged);
  ASSERT_GT(free.iterations, 2);

  newton.bound_laws(newton.system().potentials().looked_at() + 1);
  const NewtonReport bounded = knee.solve(newton);
  EXPECT_EQ(bounded.outcome, NewtonOutcome::kIterationLimit);
  EXPECT_LT(bounded.iterations, free.iterations);

  newton.bound_laws(std::numeric_limits<long>::max());
  EXPECT_EQ(knee.solve(newton).outcome, NewtonOutcome::kConverged);
}

// Rigid contacts have no laws: the bound is none of theirs.
TEST(BoundedLaws, HaveNoSayWithoutLaws) {
  const DisplacedKnee knee(test::quadric_knee());
  Newton newton(knee.model), bounded(knee.model);
  bounded.bound_laws(0);
  const NewtonReport expected = knee.solve(newton), report = knee.solve(bounded);
  EXPECT_EQ(report.outcome, expected.outcome);
  EXPECT_EQ(report.iterations, expected.iterations);
  EXPECT_GT(report.iterations, 0);
}

}  // namespace
}  // namespace condyle
