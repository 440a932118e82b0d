/// Poor starts and long ways come to the same pose; and nothing is allocated on the way.

#include <gtest/gtest.h>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/math/degree.h"
#include "equilibrium/displaced.h"
#include "support/allocation_count.h"
#include "support/quadric_knee.h"
#include "support/random.h"

namespace condyle {
namespace {

/// A pose displaced by up to 8 mm along each axis, 16 degrees about the flexion axis and 8 degrees
/// about the others: far into overlaps and gaps.

struct Count {
  int lost = 0, elsewhere = 0;
  void add(const PoseResult& pose, const PoseResult& expected) {
    lost += pose.converged() ? 0 : 1;
    const double away =
        (pose.X_BA.p - expected.X_BA.p).norm() + (pose.X_BA.R - expected.X_BA.R).norm();
    elsewhere += pose.converged() && away > 1e-8 ? 1 : 0;
  }
};

class DisplacedStarts : public testing::TestWithParam<unsigned> {
 protected:
  static Model knee() {
    Model model = test::quadric_knee();
    model.conditions[0].value = 35 * kDegree;
    return model;
  }
};

TEST_P(DisplacedStarts, AHundredComeToOnePose) {
  EquilibriumSolver reference(knee());
  const PoseResult expected = reference.solve();
  ASSERT_TRUE(expected.converged()) << expected.reason;
  test::Random random(GetParam());
  Count count;
  for (int trial = 0; trial < 100; ++trial) {
    Model model = knee();
    model.start = displaced(expected.X_BA, random);
    EquilibriumSolver solver(std::move(model));
    count.add(solver.solve(), expected);
  }
  EXPECT_EQ(count.lost, 0);
  EXPECT_EQ(count.elsewhere, 0);
}

INSTANTIATE_TEST_SUITE_P(FiveTimes, DisplacedStarts, testing::Values(1u, 2u, 3u, 4u, 5u));

TEST(Globalisation, OneStepFrom0To120DegreesLandsWhereSmallStepsLand) {
  EquilibriumSolver walker(test::quadric_knee()), jumper(test::quadric_knee());
  PoseResult walked;
  for (int flexion = 0; flexion <= 120; flexion += 5) {
    walked = walker.solve(condition_value(0).with(drive_of(walker.model()), flexion * kDegree));
    ASSERT_TRUE(walked.converged()) << flexion << ": " << walked.reason;
  }
  ASSERT_TRUE(jumper.solve().converged());
  const PoseResult jumped =
      jumper.solve(condition_value(0).with(drive_of(jumper.model()), 120 * kDegree));
  ASSERT_TRUE(jumped.converged()) << jumped.reason;
  EXPECT_LT((jumped.X_BA.p - walked.X_BA.p).norm(), 1e-8);
}

TEST(Globalisation, NothingIsAllocatedAfterTheFirstPoses) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "allocations are not counted here";
  EquilibriumSolver solver(test::quadric_knee());
  Drive drive = drive_of(solver.model());
  PoseResult pose;
  const auto sweep = [&](int from, int to) {
    for (int flexion = from; flexion <= to; flexion += 5) {
      drive.values[0] = flexion * kDegree;
      solver.solve(drive, pose);
      ASSERT_TRUE(pose.converged()) << pose.reason;
    }
  };
  sweep(0, 10);
  const test::AllocationCount count;
  sweep(15, 90);
  EXPECT_EQ(count.since_start(), 0);
}

}  // namespace
}  // namespace condyle
