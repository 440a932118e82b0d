/// Predictions of a table's rows: against sweeps, work and each other; what is lost and what stays.

#include "condyle/calibration/predictions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/measured_predictions.h"
#include "condyle/elements/joint_table.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"

namespace condyle::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Predictions, ALaxityIsTheDifferenceOfOppositeLevels) {
  Measured knee;
  add_coordinates("there", 30 * kDegree, 0, 100, knee.table);
  add_coordinates("back", 30 * kDegree, 0, -100, knee.table);
  for (std::size_t c = 1; c < 6; ++c)
    knee.add_row(MeasuredKind::kJointCoordinate, c, 0, 100, 30).laxity = true;
  knee.parameters = free_strains(knee.scene);
  Predictions predictions = knee.predictions();
  VectorXd y;
  MatrixXd J;
  ASSERT_TRUE(predictions.evaluate(VectorXd::Zero(12), y, &J)) << predictions.failure();
  EXPECT_LT((y.segment(10, 5) - y.segment(0, 5) + y.segment(5, 5)).norm(), 1e-14);
  EXPECT_LT((J.middleRows(10, 5) - J.middleRows(0, 5) + J.middleRows(5, 5)).norm(), 1e-12);
  EXPECT_GT(y[13], 1);  // [mm]
}

TEST(Predictions, AreTheJointCoordinatesOfASweepAtThoseLoads) {
  Measured knee;
  knee.scene.calibration->relative = {"relative"};
  add_coordinates("anterior", 30 * kDegree, 0, 50, knee.table);
  add_coordinates("anterior", 30 * kDegree, 0, 100, knee.table);
  add_coordinates("relative", 30 * kDegree, 0, 100, knee.table);
  knee.parameters = free_strains(knee.scene);
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd::Zero(12), y, nullptr)) << predictions.failure();

  // The same knee without what other tests hold.
  Scene scene = knee.scene;
  scene.conditions.resize(1);
  EquilibriumSolver solver(build_model(scene, fit_surfaces(scene)));
  SweepOptions options;
  options.drive = drive_of(solver.model());
  options.drive->scales = {0, 0, 0};
  std::vector<double> flexions, levels;
  for (int i = 0; i <= 6; ++i) flexions.push_back(5 * kDegree * i);
  for (int i = 0; i <= 10; ++i) levels.push_back(0.1 * i);
  (void)sweep(solver, condition_value(0), flexions, options);
  options.drive->values[0] = 30 * kDegree;
  const SweepResult drawer = sweep(solver, load_scale(0), levels, options);
  ASSERT_EQ(drawer.count_converged(), 11);
  EXPECT_GT(drawer.poses.back().joint.anterior_drawer - drawer.poses[0].joint.anterior_drawer, 0.5);
  for (std::size_t c = 1; c < 6; ++c) {
    const auto of = [&](std::size_t pose) {
      return drawer.poses[pose].joint.*kJointCoordinates[c].member;
    };
    const auto row = static_cast<Eigen::Index>(c) - 1;
    EXPECT_NEAR(y[row], of(5), 1e-9);
    EXPECT_NEAR(y[5 + row], of(10), 1e-9);
    EXPECT_NEAR(y[10 + row], of(10) - of(0), 1e-9);
  }
}

// What holds the drawer does the work on the ligaments: its integral over the drawer is what they store
// more of, and it is positive where it drives the drawer up.
TEST(Predictions, TheReactionIsTheWorkOfWhatIsHeld) {
  Measured knee;
  const std::vector<double> drawn = {-7.6, -7.4, -7.2};
  for (const double level : drawn) {
    knee.add_row(MeasuredKind::kReaction, 0, 3, level, 20);
    for (std::size_t i = 0; i < 12; ++i)
      knee.add_row(MeasuredKind::kLigamentForce, i, 3, level, 20);
  }
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, nullptr)) << predictions.failure();
  // Energy by the force of a toe-linear law, which tells the strain.
  const auto energy = [&](Eigen::Index pose) {
    double sum = 0;
    for (std::size_t i = 0; i < 12; ++i) {
      const auto& law = std::get<ToeLinearLaw>(knee.scene.ligaments[i].law);
      const double force = y[13 * pose + 1 + static_cast<Eigen::Index>(i)];
      const double k = law.stiffness, toe = law.transition_strain;
      const double strain =
          force > k * toe / 2 ? force / k + toe / 2 : std::sqrt(2 * toe * force / k);
      sum += tension(law, law.slack_length * (1 + strain)).energy;
    }
    return sum;
  };
  const double work = (drawn[2] - drawn[0]) / 6 * (y[0] + 4 * y[13] + y[26]);
  EXPECT_GT(std::abs(work), 1);
  EXPECT_NEAR(work, energy(2) - energy(0), 1e-3 * std::abs(work));
}

TEST(Predictions, WithoutAPoseAreNoneAndLeaveEverythingAsItWas) {
  Measured knee = all_kinds();
  knee.parameters = free_strains(knee.scene);
  Predictions predictions = knee.predictions(), other = knee.predictions();
  const VectorXd theta = some_theta(knee, 1);
  VectorXd y, y_other;
  ASSERT_TRUE(predictions.evaluate(theta, y, nullptr));
  ASSERT_TRUE(other.evaluate(theta, y_other, nullptr));
  // No ligament ever pulls: nothing carries the loads.
  EXPECT_FALSE(predictions.evaluate(VectorXd::Constant(12, -0.9), y, nullptr));
  EXPECT_NE(predictions.failure().find("knee.csv:"), std::string::npos) << predictions.failure();
  // A strain that no line has.
  EXPECT_FALSE(predictions.evaluate(VectorXd::Constant(12, -5), y, nullptr));
  EXPECT_EQ(predictions.failure(), "the slack length of \"APL\" is not positive");
  const VectorXd next = some_theta(knee, 1, 4);
  ASSERT_TRUE(predictions.evaluate(next, y, nullptr));
  ASSERT_TRUE(other.evaluate(next, y_other, nullptr));
  EXPECT_LT((y - y_other).lpNorm<Eigen::Infinity>(), 1e-10);
}

TEST(Predictions, DoNotDependOnTheOrderOfEvaluationsAndStartAgainToTheLastBit) {
  Measured knee = all_kinds();
  knee.parameters = free_strains(knee.scene);
  const VectorXd a = some_theta(knee, 2, 1), b = some_theta(knee, 2, 2);
  Predictions predictions = knee.predictions();
  VectorXd first, again, unused;
  MatrixXd J_first, J_again;
  ASSERT_TRUE(predictions.evaluate(a, first, &J_first)) << predictions.failure();
  ASSERT_TRUE(predictions.evaluate(b, unused, nullptr)) << predictions.failure();
  ASSERT_TRUE(predictions.evaluate(a, again, &J_again));
  EXPECT_LT((first - again).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((J_first - J_again).norm(), 1e-9 * J_first.norm());
  predictions.reset();
  ASSERT_TRUE(predictions.evaluate(a, again, &J_again));
  EXPECT_TRUE(first == again);
  EXPECT_TRUE(J_first == J_again);
  Predictions copy(knee.predictions());
  ASSERT_TRUE(copy.evaluate(a, again, &J_again));
  EXPECT_TRUE(first == again);
  EXPECT_LT(predictions.difference_of_cold_path(a), 1e-7);
}

TEST(Predictions, ARowThatIsFittedNeedsAPoseAndATestIsLostWithoutOne) {
  Measured knee;
  add_coordinates("passive", 20 * kDegree, -1, 0, knee.table);
  knee.add_row(MeasuredKind::kReaction, 0, 3, 500, 20).use = MeasuredUse::kTest;
  knee.table.rows.back().line = 88;
  Predictions predictions = knee.predictions();
  VectorXd y;
  MatrixXd J;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, &J));
  EXPECT_TRUE(y.head(5).allFinite());
  EXPECT_TRUE(std::isnan(y[5]));
  knee.table.rows.back().use = MeasuredUse::kFit;
  try {
    (void)knee.predictions();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("knee.csv:88"), std::string::npos) << error.what();
  }
}

// What a test holds has an error too: a part of that displacement.
TEST(Predictions, VarianceOfAHeldLevel) {
  Measured knee;
  knee.scene.calibration->level_sd = 0.02;
  constexpr double h = 1e-4, kLevel = -9;
  for (const double level : {kLevel, kLevel * (1 - h), kLevel * (1 + h)})
    add_coordinates("drawn", 20 * kDegree, 3, level, knee.table);
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, nullptr));
  const auto rows = static_cast<Eigen::Index>(knee.table.rows.size() / 3);
  const VectorXd variance = predictions.input_variance(VectorXd());
  EXPECT_GT(variance.head(rows).maxCoeff(), 1e-6);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double by_level = (y[2 * rows + i] - y[rows + i]) / (2 * h) * 0.02;
    EXPECT_NEAR(variance[i], by_level * by_level, 1e-4 * by_level * by_level + 1e-12);
  }
}

// Errors of what is prescribed: against poses at other flexions and levels.
TEST(Predictions, VarianceOfFlexionAndLevel) {
  Measured knee;
  knee.scene.calibration->flexion_sd = 1 * kDegree;
  knee.scene.calibration->level_sd = 0.02;
  knee.scene.calibration->relative = {"varus"};
  constexpr double h = 1e-3, kLevel = 80;
  // Rows 0 to 4, then at other flexions, then at other levels.
  for (const double flexion : {20 * kDegree, 20 * kDegree - h, 20 * kDegree + h})
    add_coordinates("varus", flexion, 0, kLevel, knee.table);
  for (const double level : {kLevel * (1 - h), kLevel * (1 + h)})
    add_coordinates("varus", 20 * kDegree, 0, level, knee.table);
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, nullptr));
  const VectorXd variance = predictions.input_variance(VectorXd());
  for (Eigen::Index i = 0; i < 5; ++i) {
    const double by_flexion = (y[10 + i] - y[5 + i]) / (2 * h) * kDegree;
    const double by_level = (y[20 + i] - y[15 + i]) / (2 * h) * 0.02;
    const double expected = by_flexion * by_flexion + by_level * by_level;
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(variance[i], expected, 1e-4 * expected);
  }
}

TEST(Predictions, TellTheGreatestForceOfEachLigament) {
  Measured knee;
  for (const double level : {-100.0, 100.0})
    for (std::size_t i = 0; i < 12; ++i)
      knee.add_row(MeasuredKind::kLigamentForce, i, 0, level, 20);
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, nullptr));
  const std::vector<double> greatest = predictions.largest_ligament_forces();
  ASSERT_EQ(greatest.size(), 12U);
  for (Eigen::Index i = 0; i < 12; ++i)
    EXPECT_EQ(greatest[static_cast<std::size_t>(i)], std::max(y[i], y[12 + i]));
  EXPECT_GT(*std::max_element(greatest.begin(), greatest.end()), 20);
}

}  // namespace
}  // namespace condyle::test
