/// Samples of a study: what they must equal, and what they must not depend on.

#include "condyle/study/study_worker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "condyle/equilibrium/sweep.h"
#include "study/small_study.h"
#include "support/allocation_count.h"

namespace condyle::test {
namespace {

/// A plan with a few values of its knee's sweep.
StudyPlan plan_of(const std::string& scene, const std::vector<double>& degrees, bool stiffnesses) {
  return study_plan(at_flexions(small_study(scene, 16, stiffnesses), degrees));
}

SweepResult swept_anew(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  SweepOptions options;
  options.stability = options.events = false;
  return sweep(scene, surfaces, options);
}

/// In the outputs' units; numbers of hundreds count relatively.
void expect_poses(const Left& left,
                  const SweepResult& sweep,
                  const StudyPlan& plan,
                  double tolerance,
                  double tolerance_of_first) {
  ASSERT_EQ(left.status.size(), sweep.poses.size());
  for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
    ASSERT_EQ(left.status[i], static_cast<int>(sweep.poses[i].status)) << i;
    for (std::size_t k = 0; k < plan.outputs.size() && sweep.poses[i].converged(); ++k) {
      const StudyOutput& output = plan.outputs[k];
      const double expected = value_of(output.output, sweep.poses[i]) / output.unit.factor;
      EXPECT_NEAR(left.values[i * plan.outputs.size() + k], expected,
                  (i == 0 ? tolerance_of_first : tolerance) * std::max(1.0, std::abs(expected)))
          << output.name << " at pose " << i;
    }
  }
}

std::vector<double> no_change(const StudyPlan& plan) {
  return std::vector<double>(plan.parameters.size(), 0.0);
}

/// Strains and ln k some way off, up and down in turn.
std::vector<double> some_change(const StudyPlan& plan, double by = 1) {
  std::vector<double> theta;
  for (std::size_t j = 0; j < plan.parameters.size(); ++j) {
    const double size = plan.parameters[j].logarithmic ? 0.15 : 0.012;
    theta.push_back(by * size * std::sin(1.7 * static_cast<double>(j) + 0.4));
  }
  return theta;
}

bool same_bits(const Left& a, const Left& b) {
  return a.status == b.status && a.values.size() == b.values.size() &&
         std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(double)) == 0;
}

struct Case {
  const char* scene;
  std::vector<double> degrees;
  /// The lattice of a layer is laid where the search for a pose begins, for the first pose of a sweep at
  /// the start pose: what it leaves out of a force differs.
  double lattice = 0;
};
const Case kCases[] = {{"wismans-type/knee.toml", {0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50}},
                       {"phantom/knee.toml", {0, 10, 20, 30, 60}},
                       {"phantom/wrapped.toml", {0, 10, 20}},
                       {"phantom/layered.toml", {10, 20}, 3e-3}};

TEST(StudyWorker, UnchangedItIsTheScenesOwnSweep) {
  for (const auto& [scene, degrees, lattice] : kCases) {
    SCOPED_TRACE(scene);
    const StudyPlan plan = plan_of(scene, degrees, true);
    StudyWorker worker(plan, study_models(plan));
    expect_poses(evaluated(worker, plan, no_change(plan)),
                 swept_anew(plan.knees[0].scene, plan.knees[0].surfaces), plan, 1e-9,
                 std::max(1e-9, lattice));
  }
}

TEST(StudyWorker, ChangedItIsTheSweepOfASceneWithTheseNumbers) {
  for (const auto& [scene, degrees, lattice] : kCases) {
    SCOPED_TRACE(scene);
    const StudyPlan plan = plan_of(scene, degrees, true);
    StudyWorker worker(plan, study_models(plan));
    const std::vector<double> theta = some_change(plan);
    const StudyKnee& knee = plan.knees[0];
    const Left left = evaluated(worker, plan, theta);
    expect_poses(left, swept_anew(scene_with(knee.scene, knee.parameters, theta), knee.surfaces),
                 plan, 1e-8, std::max(1e-8, lattice));
    EXPECT_FALSE(same_bits(left, evaluated(worker, plan, no_change(plan))));
  }
}

TEST(StudyWorker, LoadsAreFactorsOnTheScenes) {
  ReadStudy study = at_flexions(small_study("phantom/drawer.toml", 1), {});
  Scene& scene = study.scenes[0];
  ASSERT_FALSE(scene.loads.empty());
  scene.sweep->values = {0.5};
  VariedNumber load;
  load.number.what = ParameterKind::kLoadScale;
  load.number.prior_sd = 0.1;
  load.number.of = {0};
  study.varied[0] = {load};
  const StudyPlan plan = study_plan(study);
  ASSERT_EQ(plan.parameters.size(), 1u);
  StudyWorker worker(plan, study_models(plan));
  const StudyKnee& knee = plan.knees[0];
  const std::vector<double> theta = {std::log(1.4)};
  expect_poses(evaluated(worker, plan, theta),
               swept_anew(scene_with(knee.scene, knee.parameters, theta), knee.surfaces), plan,
               1e-8, 1e-8);
}

TEST(StudyWorker, ASampleDoesNotDependOnTheOneBefore) {
  const StudyPlan plan = plan_of("phantom/knee.toml", {0, 15, 30, 60}, true);
  const auto models = study_models(plan);
  std::vector<std::vector<double>> thetas;
  for (const double by : {1.0, -1.0, 2.0, 60.0, -0.5, 8.0}) thetas.push_back(some_change(plan, by));
  std::vector<Left> alone;
  for (const auto& theta : thetas) {
    StudyWorker fresh(plan, models);
    alone.push_back(evaluated(fresh, plan, theta));
  }
  StudyWorker worker(plan, models);
  for (std::size_t k = 0; k < thetas.size(); ++k)
    EXPECT_TRUE(same_bits(evaluated(worker, plan, thetas[k]), alone[k])) << k;
  for (std::size_t k = thetas.size(); k-- > 0;)
    EXPECT_TRUE(same_bits(evaluated(worker, plan, thetas[k]), alone[k])) << "backwards " << k;
}

TEST(StudyWorker, NumbersThatNoKneeHasAreAStatus) {
  const StudyPlan plan = plan_of("wismans-type/knee.toml", {0, 10}, false);
  StudyWorker worker(plan, study_models(plan));
  const Left before = evaluated(worker, plan, some_change(plan));
  std::vector<double> impossible = no_change(plan);
  impossible[2] = -5;  // a slack length below zero
  const Left left = evaluated(worker, plan, impossible);
  for (const std::uint8_t status : left.status)
    EXPECT_EQ(status, static_cast<int>(PoseStatus::kNotComputed));
  for (const double value : left.values) EXPECT_TRUE(std::isnan(value));
  EXPECT_TRUE(same_bits(evaluated(worker, plan, some_change(plan)), before));
}

/// Ligaments so long that nothing holds the tibia: some poses have no equilibrium.
TEST(StudyWorker, AFailedPoseIsNotANumberAndLeavesTheOthersAlone) {
  const StudyPlan plan = plan_of("wismans-type/knee.toml", {0, 15, 30, 45}, false);
  StudyWorker worker(plan, study_models(plan));
  const std::vector<double> slack(plan.parameters.size(), -0.3);
  const Left failed = evaluated(worker, plan, slack);
  std::size_t failures = 0;
  for (std::size_t i = 0; i < failed.status.size(); ++i) {
    failures += failed.status[i] != 0 ? 1 : 0;
    for (std::size_t k = 0; k < plan.outputs.size(); ++k)
      EXPECT_EQ(std::isnan(failed.values[i * plan.outputs.size() + k]), failed.status[i] != 0);
  }
  EXPECT_GT(failures, 0u);
  const Left after = evaluated(worker, plan, no_change(plan));
  StudyWorker fresh(plan, study_models(plan));
  EXPECT_TRUE(same_bits(after, evaluated(fresh, plan, no_change(plan))));
}

/// What searches of contacts measure of surfaces is kept, once for each place.
TEST(StudyWorker, AllocatesNothingForSamplesLikeThoseBefore) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted here";
  for (const char* scene : {"wismans-type/knee.toml", "phantom/knee.toml"}) {
    SCOPED_TRACE(scene);
    const StudyPlan plan = plan_of(scene, {0, 5, 10, 15}, true);
    StudyWorker worker(plan, study_models(plan));
    std::vector<std::uint8_t> status(plan.values.size());
    std::vector<double> values(plan.numbers());
    for (std::uint64_t k = 0; k < 8; ++k) worker.evaluate(k, status.data(), values.data());
    const AllocationCount count;
    for (std::uint64_t k = 8; k-- > 0;) worker.evaluate(k, status.data(), values.data());
    EXPECT_EQ(count.since_start(), 0);
  }
}

TEST(StudyWorker, ItsOwnMeshIsMadeRoughBySeed) {
  ReadStudy study = at_flexions(small_study("phantom/knee.toml", 4), {0, 10});
  study.study.roughness = VariedRoughness{0.05, 4};
  const StudyPlan plan = study_plan(study);
  ASSERT_EQ(plan.parameters.back().name, "roughness.seed");
  StudyWorker worker(plan, study_models(plan));
  std::vector<double> theta = no_change(plan);
  theta.back() = 0.25;
  const Left one = evaluated(worker, plan, theta);
  theta.back() = 0.75;
  const Left other = evaluated(worker, plan, theta);
  EXPECT_EQ(one.status, std::vector<std::uint8_t>(2, 0));
  EXPECT_FALSE(same_bits(one, other));
  theta.back() = 0.25;
  EXPECT_TRUE(same_bits(one, evaluated(worker, plan, theta)));
}

}  // namespace
}  // namespace condyle::test
