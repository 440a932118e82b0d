/// A pose is a function of a constant model, a drive and the pose before: solvers share the model,
/// and one that is reset knows nothing of what it solved before.

#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/model_covers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "condyle/equilibrium/arc_length.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/carried_pose.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/linearization.h"
#include "condyle/equilibrium/path_system.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/allocation_count.h"
#include "support/counted_model.h"
#include "support/patch_knee.h"
#include "support/words_of.h"

namespace condyle {
namespace {

using test::words_of;

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
  for (const double none : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const Swept& swept : {condition_value(0), load_scale(0)})
      EXPECT_EQ(words_of([&] { solver.solve(swept.with(drive_of(*model), none), pose); }),
                "the drive holds a number that is not finite");
  EXPECT_TRUE(solver.solve().converged());  // none of this has left a trace
}

TEST_F(SharedKnee, ASweptNumberThatIsNoneIsAnErrorInWords) {
  EquilibriumSolver solver(model, covers);
  const Swept load = load_scale(model->loads.size()), condition = condition_value(7);
  const auto words = [](const std::function<void()>& wrong) -> std::string {
    try {
      wrong();
    } catch (const std::out_of_range& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  const std::string of_loads = "number 1 is swept of the 1 scales of loads that the drive has";
  const std::string of_conditions =
      "number 7 is swept of the 1 values of conditions that the drive has";
  EXPECT_EQ(words([&] { (void)sweep(solver, load, {0}); }), of_loads);
  EXPECT_EQ(words([&] { (void)sweep(solver, condition, {0}); }), of_conditions);
  EXPECT_EQ(words([&] { (void)follow_path(solver, condition, 0, 1, 1); }), of_conditions);
  EXPECT_EQ(words([&] { PathSystem(*model, condition, drive_of(*model), 1); }), of_conditions);
  EXPECT_EQ(words([&] { (void)condition.with(drive_of(*model), 1); }), of_conditions);
  EXPECT_TRUE(solver.solve().converged());
}

// A state of another model has other multipliers, or contacts of pairs that are none.
TEST_F(SharedKnee, AStateOfAnotherModelIsAnErrorInWords) {
  EquilibriumSolver solver(model, covers);
  ASSERT_TRUE(solver.solve().converged());
  const Drive drive = drive_of(*model);
  const EquilibriumState good = solver.state();
  EquilibriumState more = good, other = good;
  more.sigma.push_back(0);
  other.contacts[0].pair = 2;
  const std::string of_more = "the state has 2 multipliers, expected 1 as the model has conditions";
  const std::string of_other =
      "a contact of the state is of pair 2, expected one of the 2 that the model has";
  Newton newton(*model);
  NewtonSystem system(*model);
  for (const auto& [wrong, words] : {std::pair{more, of_more}, std::pair{other, of_other}}) {
    EquilibriumState state = wrong;
    EXPECT_EQ(words_of([&] { solver.set_state(state, drive); }), words);
    EXPECT_EQ(words_of([&] { solver.go_back({state, drive, true}); }), words);
    EXPECT_EQ(words_of([&] { newton.solve(state, drive); }), words);
    EXPECT_EQ(words_of([&] { system.assemble(state, drive); }), words);
  }
  EXPECT_EQ(solver.state().X.p, good.X.p);
}

// What was assembled at one state says nothing of another one.
TEST_F(SharedKnee, ALinearizationOfAnotherStateIsAnErrorInWords) {
  EquilibriumSolver solver(model, covers);
  ASSERT_TRUE(solver.solve().converged());
  const Drive drive = drive_of(*model);
  const EquilibriumState state = solver.state();
  NewtonSystem system(*model);
  ASSERT_TRUE(system.assemble(state, drive));
  EXPECT_EQ(linearization(system, state, drive).constraints(), 3U);
  const char* words = "the system was last assembled at another state";
  EquilibriumState moved = state, opened = state;
  moved.X.p.x() += 1e-9;
  opened.contacts.pop_back();
  EXPECT_EQ(words_of([&] { (void)linearization(system, moved, drive); }), words);
  EXPECT_EQ(words_of([&] { (void)linearization(system, opened, drive); }), words);
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

// A pose is given up after so much work: what is counted of it is part of the result.
TEST_F(SharedKnee, AResetSolverSpendsOnAPoseWhatANewOneDoes) {
  EquilibriumSolver used(model, covers);
  follow(used, {90, 80, 70, 10});
  EquilibriumSolver searched(model, covers);
  (void)solve(searched, 45);
  for (const double flexion : {0.0, 5.0, 50.0, 100.0, 110.0, 120.0}) {
    EquilibriumSolver fresh(model, covers);
    const PoseResult expected = fresh.solve(at(flexion));
    for (int time = 0; time < 2; ++time) {
      used.reset();
      EXPECT_EQ(BitsOf(used.solve(at(flexion))).bits, BitsOf(expected).bits) << flexion;
      EXPECT_EQ(used.spent().points, fresh.spent().points) << flexion << ", time " << time;
    }
    // Searches that begin where those of another solver did, likewise.
    EquilibriumSolver beginning(model, covers);
    beginning.reset(searched.searches());
    (void)beginning.solve(at(flexion));
    used.reset(searched.searches());
    (void)used.solve(at(flexion));
    EXPECT_EQ(used.spent().points, beginning.spent().points) << flexion;
  }
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
  const auto expect_refused = [&](std::size_t elements, std::size_t loads) {
    const std::string words = "the parameters are of " + std::to_string(elements) +
                              " line elements and " + std::to_string(loads) + " loads, expected " +
                              std::to_string(model->elements.size()) + " and " +
                              std::to_string(model->loads.size()) + " as the model has";
    NewtonSystem system(*model);
    PathSystem path(*model, condition_value(0), drive_of(*model), 1);
    EXPECT_EQ(words_of([&] { solver.set_parameters(parameters); }), words);
    EXPECT_EQ(words_of([&] { system.set_parameters(parameters); }), words);
    EXPECT_EQ(words_of([&] { path.set_parameters(parameters); }), words);
  };
  parameters.loads.pop_back();
  expect_refused(model->elements.size(), model->loads.size() - 1);
  // A parameter that is no ligament's.
  parameters = parameters_of(*model);
  parameters.elements.push_back(parameters.elements[0]);
  expect_refused(model->elements.size() + 1, model->loads.size());
  EXPECT_TRUE(solver.solve().converged());
}

/// 100 N at half their scale are 50 N.
TEST(Parameters, TheScaleOfADescribedLoadIsThatOfTheNominalDrive) {
  Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/drawer.toml");
  const auto pose_with = [&](double vector, double scale) {
    scene.loads[0].vector = {0, vector, 0};
    scene.loads[0].scale = scale;
    EquilibriumSolver solver(build_model(scene, fit_surfaces(scene)));
    EXPECT_EQ(drive_of(solver.model()).scales[0], scale);
    return solver.solve().joint.anterior_drawer;
  };
  EXPECT_NEAR(pose_with(100, 0.5), pose_with(50, 1), 1e-10);
  EXPECT_GT(pose_with(100, 1) - pose_with(100, 0), 0.1);
}

}  // namespace
}  // namespace condyle
