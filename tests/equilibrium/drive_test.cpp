/// A pose is a function of a constant model, a drive and the pose before: solvers share the model,
/// and one that is reset knows nothing of what it solved before.

#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/model_covers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "condyle/equilibrium/arc_length.h"
#include "condyle/equilibrium/carried_pose.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/sweep.h"
#include "support/allocation_count.h"
#include "support/counted_model.h"
#include "support/patch_knee.h"

namespace condyle {
namespace {

constexpr double kDegree = M_PI / 180;

using Bits = std::vector<std::uint64_t>;

/// All numbers that a pose tells of its equilibrium, to the last bit.
class BitsOf {
 public:
  explicit BitsOf(const PoseResult& pose) {
    add(static_cast<double>(pose.status));
    add(pose.iterations);
    add(pose.residual);
    add(pose.X_BA.p);
    for (int i = 0; i < 3; ++i) add(Eigen::Vector3d(pose.X_BA.R.col(i)));
    add(pose.lowest_stiffness);
    for (const LigamentResult& ligament : pose.ligaments) {
      add(ligament.length);
      add(ligament.force);
    }
    for (const ConditionResult& condition : pose.conditions) {
      add(condition.value);
      add(condition.multiplier);
    }
    for (const ContactResult& contact : pose.contacts) {
      add(contact.force);
      for (const ContactPointResult& point : contact.points) {
        add(point.force);
        add(point.gap);
        add(point.edge_distance);
        add(point.point_ground);
        add(point.point_moving);
      }
    }
  }
  Bits bits;

 private:
  void add(double value) { std::memcpy(&bits.emplace_back(), &value, sizeof value); }
  void add(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
};

/// The knee of patches, and what its solvers share.
class SharedKnee : public testing::Test {
 protected:
  std::shared_ptr<const Model> model = std::make_shared<const Model>(benchmarks::patch_knee());
  ContactCovers covers = cover_pairs(*model);

  [[nodiscard]] Drive at(double flexion) const {
    return condition_value(0).with(drive_of(*model), flexion * kDegree);
  }
  Bits solve(EquilibriumSolver& solver, double flexion) const {
    const PoseResult pose = solver.solve(at(flexion));
    EXPECT_TRUE(pose.converged()) << flexion << ": " << pose.reason;
    return BitsOf(pose).bits;
  }
  /// From each value to the next.
  std::vector<Bits> follow(EquilibriumSolver& solver, const std::vector<double>& flexions) const {
    std::vector<Bits> poses;
    for (const double flexion : flexions) poses.push_back(solve(solver, flexion));
    return poses;
  }
};

std::string words_of(const std::function<void()>& wrong) {
  try {
    wrong();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(SharedKnee, ADriveOfTheWrongSizeIsAnErrorInWords) {
  EquilibriumSolver solver(model, covers);
  Newton newton(*model);
  EquilibriumState state = solver.state();
  PoseResult pose;
  for (const bool loads : {false, true}) {
    Drive drive = drive_of(*model);
    (loads ? drive.scales : drive.values).push_back(1);
    const std::string expected =
        "the drive has " + std::to_string(drive.values.size()) + " values of conditions and " +
        std::to_string(drive.scales.size()) + " scales of loads, expected " +
        std::to_string(model->conditions.size()) + " and " + std::to_string(model->loads.size()) +
        " as the model has";
    SweepOptions options;
    options.drive = drive;
    PathOptions path;
    path.drive = drive;
    EXPECT_EQ(words_of([&] { solver.solve(drive, pose); }), expected);
    EXPECT_EQ(words_of([&] { solver.set_state(state, drive); }), expected);
    EXPECT_EQ(words_of([&] { newton.solve(state, drive); }), expected);
    EXPECT_EQ(words_of([&] { (void)carried(*model, drive, state.X); }), expected);
    EXPECT_EQ(words_of([&] { (void)sweep(solver, condition_value(0), {0}, options); }), expected);
    EXPECT_EQ(words_of([&] { (void)follow_path(solver, condition_value(0), 0, 1, 1, path); }),
              expected);
  }
  EXPECT_THROW((void)sweep(solver, load_scale(model->loads.size()), {0}), std::out_of_range);
  EXPECT_TRUE(solver.solve().converged());  // none of this has left a trace
}

TEST_F(SharedKnee, CoversOfAnotherModelAreAnError) {
  const auto other = std::make_shared<const Model>(benchmarks::patch_knee());
  EXPECT_EQ(words_of([&] { EquilibriumSolver(other, covers); }),
            "the covers are not of the surfaces of this model");
  EXPECT_EQ(words_of([&] { EquilibriumSolver(model, ContactCovers{}); }),
            "the covers are not of the surfaces of this model");
}

// A pose is found from the one before it, so its last digits depend on that one; after a reset they
// depend on nothing but model and drive.
TEST_F(SharedKnee, AfterAResetNoBitDependsOnWhatWasSolvedBefore) {
  const std::vector<double> up = {0, 5, 10, 30, 45, 50, 90};
  std::vector<Bits> expected;
  for (const double flexion : up) {
    EquilibriumSolver fresh(model, covers);
    expected.push_back(solve(fresh, flexion));
  }
  EquilibriumSolver solver(model, covers);
  for (const std::size_t stride : {1u, 2u, 3u, 5u, 6u})  // orders of seven numbers
    for (std::size_t k = 0, i = stride; k < up.size(); ++k, i = (i + stride) % up.size()) {
      solver.reset();
      EXPECT_EQ(solve(solver, up[i]), expected[i]) << up[i] << " with stride " << stride;
    }
  // Without it they do depend: the test sees it.
  std::vector<double> down(up.rbegin(), up.rend());
  std::vector<Bits> warm = follow(solver, down);
  std::reverse(warm.begin(), warm.end());
  EXPECT_NE(warm, expected);
}

TEST_F(SharedKnee, AResetSolverSweepsAsANewOne) {
  const std::vector<double> flexions = {0, 5, 10, 15, 20, 60, 55, 50, 85, 90};
  EquilibriumSolver fresh(model, covers), used(model, covers);
  const std::vector<Bits> expected = follow(fresh, flexions);
  follow(used, {90, 80, 70, 10});
  EXPECT_FALSE(used.solve(at(120)).converged());         // beyond the patches
  used.solve(load_scale(0).with(drive_of(*model), -1));  // pulled apart: nothing carries it
  used.reset();
  EXPECT_EQ(follow(used, flexions), expected);
}

TEST(Drive, AResetBuildsNothingAndAllocatesNothing) {
  test::Asked asked;
  EquilibriumSolver solver(test::counted(benchmarks::patch_knee(), asked));
  EXPECT_TRUE(solver.solve().converged());
  asked = {};
  const test::AllocationCount count;
  solver.reset();
  EXPECT_EQ(count.since_start(), 0);
  EXPECT_EQ(asked.surfaces + asked.elements, 0);
}

TEST_F(SharedKnee, EightThreadsOnOneModelFindWhatOneFinds) {
  constexpr std::size_t kThreads = 8;
  const auto flexions_of = [](std::size_t thread) {
    std::vector<double> flexions;
    for (int k = 0; k <= 18; ++k) {
      const double flexion = 5 * ((k + 2 * static_cast<int>(thread)) % 19);
      flexions.push_back(flexion);
    }
    return flexions;
  };
  std::vector<std::vector<Bits>> expected(kThreads), found(kThreads);
  for (std::size_t t = 0; t < kThreads; ++t) {
    EquilibriumSolver solver(model, covers);
    expected[t] = follow(solver, flexions_of(t));
  }
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      EquilibriumSolver solver(model, covers);
      found[t] = follow(solver, flexions_of(t));
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 0; t < kThreads; ++t) EXPECT_EQ(found[t], expected[t]) << "thread " << t;
}

/// Ligaments and loads of other numbers, in all that may change.
Parameters other_parameters(const Model& model) {
  Parameters other = parameters_of(model);
  auto& first = std::get<ToeLinearLaw>(other.elements[0].law);
  first.stiffness *= 1.3;
  first.slack_length *= 0.98;
  other.elements[1].s_D += Eigen::Vector3d(0.5, -1, 0.3);
  const auto second = std::get<ToeLinearLaw>(other.elements[2].law);
  other.elements[2].law =
      PolynomialLaw{{-0.1 * second.stiffness, 0.1 * second.stiffness / second.slack_length}, true};
  other.loads[0].vector *= 1.1;
  return other;
}

TEST_F(SharedKnee, ChangedParametersAreThoseOfARebuiltSolver) {
  const std::vector<double> flexions = {0, 5, 10, 15, 60};
  const Parameters parameters = other_parameters(*model);
  Model changed = *model;
  changed.elements = parameters.elements;
  changed.loads = parameters.loads;
  EquilibriumSolver rebuilt(std::make_shared<const Model>(changed), covers), solver(model, covers);
  const std::vector<Bits> before = follow(solver, flexions);
  solver.set_parameters(parameters);
  solver.reset();
  const std::vector<Bits> expected = follow(rebuilt, flexions);
  EXPECT_EQ(follow(solver, flexions), expected);
  EXPECT_NE(before, expected);
  solver.set_parameters(parameters_of(*model));
  solver.reset();
  EXPECT_EQ(follow(solver, flexions), before);
  // Events and the path of equilibria see them too.
  solver.set_parameters(parameters);
  solver.reset();
  rebuilt.reset();
  const SweepResult a = follow_path(solver, condition_value(0), 0, 0.5, 0.1),
                    b = follow_path(rebuilt, condition_value(0), 0, 0.5, 0.1);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t k = 0; k < a.poses.size(); ++k)
    EXPECT_EQ(BitsOf(a.poses[k]).bits, BitsOf(b.poses[k]).bits);
}

TEST_F(SharedKnee, ParametersCostNoRebuildingAndMustFit) {
  EquilibriumSolver solver(model, covers);
  EXPECT_TRUE(solver.solve().converged());
  Parameters parameters = parameters_of(*model);
  parameters.elements[0].x_C.x() += 1;
  const test::AllocationCount count;
  solver.set_parameters(parameters);
  EXPECT_EQ(count.since_start(), 0);
  EXPECT_TRUE(solver.solve().converged());
  parameters.loads.pop_back();
  EXPECT_EQ(words_of([&] { solver.set_parameters(parameters); }),
            "the parameters are of " + std::to_string(model->elements.size()) +
                " line elements and " + std::to_string(model->loads.size() - 1) +
                " loads, expected " + std::to_string(model->elements.size()) + " and " +
                std::to_string(model->loads.size()) + " as the model has");
}

}  // namespace
}  // namespace condyle
