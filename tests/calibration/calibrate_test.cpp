/// A whole calibration: the truth comes back where nothing disturbs it, intervals hold it where noise
/// does, and tests that were not made are predicted.

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/wismans_calibration.h"
#include "condyle/calibration/calibration.h"
#include "condyle/calibration/knee_fit.h"
#include "support/scratch_folder.h"

namespace condyle::test {
namespace {

using Eigen::VectorXd;

CalibrationResult calibrated(const WismansCase& knee, const CalibrationOptions& options) {
  return calibrate(knee.scene, knee.surfaces, knee.table, knee.meshes, options);
}

/// The fit alone.
CalibrationOptions plain() {
  CalibrationOptions options;
  options.bands = options.profiles = false;
  options.samples = 0;
  options.starts = 1;
  return options;
}

TEST(Calibrate, ExactDataWithoutPriorGiveTheTruthBack) {
  const WismansCase knee(fresh_folder("exact"), 1e6, 0);
  ASSERT_EQ(knee.parameters.size(), 12U);
  CalibrationOptions options = plain();
  options.starts = 4;
  const CalibrationResult result = calibrated(knee, options);
  EXPECT_TRUE(result.fit.converged) << result.fit.message;
  EXPECT_EQ(result.starts.size(), 1U);  // nothing says where others would begin
  EXPECT_EQ(result.fit.y.size(), 325);
  EXPECT_LT((result.fit.theta - knee.truth).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_EQ(result.known.determined, 12);
  EXPECT_LT(result.unseen.after, 1e-6);
  EXPECT_GT(result.unseen.before, 0.5);
  EXPECT_EQ(result.unseen.lost, 0);
  EXPECT_LT(result.cold_difference, 1e-6);
  EXPECT_TRUE(result.silent.empty());
}

TEST(Calibrate, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const WismansCase knee(fresh_folder("coverage"), 0.03, 0);
  KneeFit fit(knee.scene, knee.surfaces, knee.table, knee.parameters, 1);
  FitProblem problem = fit.problem();
  const VectorXd sd = problem.rows.sd;
  StudyProgress progress(nullptr);
  int covered = 0;
  double squares = 0, chi_squares = 0, effective = 0;
  constexpr int kDraws = 25;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto number = static_cast<std::uint64_t>(draw);
    const VectorXd truth =
        problem.rows.prior_sd.cwiseProduct(normal_draws(11, DrawsFor::kPriorMean, number, 12));
    ASSERT_TRUE(reach(fit.worker(), truth)) << fit.predictions().failure();
    VectorXd y;
    ASSERT_TRUE(fit.worker().evaluate(truth, y, nullptr));
    problem.rows.d = y + sd.cwiseProduct(normal_draws(11, DrawsFor::kNoise, number, sd.size()));
    fit.worker().reset();
    const LeastSquaresResult least =
        fit_by(fit.worker(), problem.rows, VectorXd::Zero(12), progress);
    EXPECT_TRUE(least.converged) << least.message;
    const Identifiability known = identifiability(least.J, sd.cwiseInverse(), problem.rows.prior_sd,
                                                  std::vector<bool>(12, false));
    const VectorXd off = (least.theta - truth).cwiseQuotient(known.sd);
    covered += static_cast<int>((off.array().abs() < 1.96).count());
    squares += off.squaredNorm();
    chi_squares += least.chi_square;
    effective += known.effective;
  }
  // Of 300 intervals, three of four standard deviations of a binomial where all were independent.
  EXPECT_NEAR(covered / (12. * kDraws), 0.95, 0.05);
  EXPECT_NEAR(squares / (12. * kDraws), 1, 0.35);
  // χ² at the least has as many degrees as rows without what the parameters take: sd √(2·325·25).
  EXPECT_NEAR(chi_squares, 325. * kDraws - effective, 4 * std::sqrt(2 * 325. * kDraws));
}

// The zero of a curve is as uncertain where none of its rows is fitted; only there it is no parameter.
TEST(Calibrate, AnUnseenCurveHasAZeroOfItsOwn) {
  WismansCase knee(fresh_folder("zeros"), 0.03, 0);
  knee.scene.calibration->curve_sd = {2, 0};
  const CalibrationResult result = calibrated(knee, plain());
  EXPECT_GT(result.parameters.size(), 12U);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const Measurement& row = result.table.rows[i];
    const bool uncertain = row.use == MeasuredUse::kTest && !kJointCoordinates[row.index].angle;
    EXPECT_NEAR(result.rows[i].sd, uncertain ? std::hypot(0.5, 2) : row.sd, 1e-12) << row.line;
  }
}

/// Everything at once.
class WholeCalibration : public ::testing::Test {
 protected:
  static CalibrationResult with(int threads) {
    CalibrationOptions options;
    options.suggest = true;
    options.samples = 30;
    options.starts = 4;
    options.threads = threads;
    return calibrated(*knee_, options);
  }
  static void SetUpTestSuite() {
    knee_ = new WismansCase(fresh_folder("whole"), 0.03, 1);
    result_ = new CalibrationResult(with(1));
  }
  static void TearDownTestSuite() {
    delete result_;
    delete knee_;
  }
  static WismansCase* knee_;
  static CalibrationResult* result_;
};
WismansCase* WholeCalibration::knee_ = nullptr;
CalibrationResult* WholeCalibration::result_ = nullptr;

TEST_F(WholeCalibration, FindsTheSameLeastFromEveryStart) {
  ASSERT_EQ(result_->starts.size(), 4U);
  for (const CalibrationStart& start : result_->starts) {
    EXPECT_TRUE(start.converged) << start.message;
    EXPECT_LT(start.distance, 1e-3);
  }
}

TEST_F(WholeCalibration, PredictsTestsThatItHasNotSeen) {
  EXPECT_EQ(result_->fitted.rows, 325);
  EXPECT_EQ(result_->unseen.rows, 60);
  EXPECT_NEAR(result_->reduced_chi_square, 1, result_->reduced_chi_square_limit - 1);
  EXPECT_NEAR(result_->unseen.after, 1, 0.3);  // noise alone: 4/√(2·60) sds
  EXPECT_GT(result_->unseen.before, 1.5);
  EXPECT_GT(result_->unseen.covered, 0.85);
  // Against the truth without noise the predictions are as good as they say.
  double squares = 0;
  for (std::size_t i = 0; i < result_->rows.size(); ++i) {
    const CalibratedRow& row = result_->rows[i];
    EXPECT_LT(row.after_sd, row.prior_sd);
    if (result_->table.rows[i].use == MeasuredUse::kTest)
      squares +=
          std::pow((row.after - knee_->exact[static_cast<Eigen::Index>(i)]) / row.after_sd, 2);
  }
  EXPECT_LT(std::sqrt(squares / 60), 2.5);
}

TEST_F(WholeCalibration, SamplesSpreadAsTheDeltaMethodSays) {
  ASSERT_EQ(result_->samples.rows() + result_->lost_samples, 30);
  EXPECT_EQ(result_->lost_samples, 0);
  const double ratio = (result_->sample_sd.cwiseQuotient(result_->known.sd)).mean();
  EXPECT_NEAR(ratio, 1, 0.2);  // of 12 sds from 30 samples, each to 13 %
}

TEST_F(WholeCalibration, ProfilesOpenUpwardsWithinThreeSds) {
  ASSERT_EQ(result_->profiles.size(), 12U);
  for (const Profile& profile : result_->profiles)
    for (const double rise : profile.chi_square) {
      EXPECT_GT(rise, -1e-6);
      EXPECT_LT(rise, 25);
    }
}

TEST_F(WholeCalibration, BandsShrinkFromPriorToPosterior) {
  ASSERT_EQ(result_->band_flexions.size(), 19U);    // [sweep] from 0 to 90 by 5 deg
  ASSERT_EQ(result_->bands.size(), 5U + 12U + 2U);  // flexion is prescribed
  EXPECT_EQ(result_->bands[0].units, "deg");
  EXPECT_EQ(result_->bands[1].quantity, "internal_rotation");
  for (const std::size_t coordinate : {1U, 3U})
    for (std::size_t k = 0; k < 19; ++k)
      EXPECT_LT(result_->bands[coordinate].after_sd[k], result_->bands[coordinate].before_sd[k]);
}

TEST_F(WholeCalibration, SuggestsTheMostTellingTestFirst) {
  ASSERT_EQ(result_->suggested.size(), 5U * 7U);
  for (std::size_t k = 1; k < result_->suggested.size(); ++k)
    EXPECT_GE(result_->suggested[k - 1].information, result_->suggested[k].information);
  EXPECT_GT(result_->suggested[0].information, 0);
  EXPECT_LT(result_->suggested[0].shrinkage, 1);
}

TEST_F(WholeCalibration, IsTheSameOnTwoThreads) {
  const CalibrationResult other = with(2);
  EXPECT_EQ(other.fit.theta, result_->fit.theta);
  EXPECT_EQ(other.samples, result_->samples);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(other.starts[k].cost, result_->starts[k].cost);
  for (std::size_t j = 0; j < 12; ++j)
    EXPECT_EQ(other.profiles[j].chi_square, result_->profiles[j].chi_square);
  EXPECT_EQ(other.poses, result_->poses);
}

TEST_F(WholeCalibration, StopsAtAWordWithTheBestSoFar) {
  CalibrationOptions options;
  int steps = 0;
  options.on_progress = [&](const std::string& stage, int, int) {
    return stage == "fit" && ++steps < 3;
  };
  VectorXd told;
  options.on_better = [&](const VectorXd& theta, double) { told = theta; };
  const CalibrationResult stopped = calibrated(*knee_, options);
  EXPECT_TRUE(stopped.stopped);
  EXPECT_FALSE(stopped.fit.converged);
  EXPECT_EQ(stopped.fit.theta, told);
  EXPECT_EQ(stopped.samples.rows(), 0);
  EXPECT_EQ(stopped.starts.size(), 1U);

  CalibrationOptions resumed = plain();
  resumed.from = told;
  const CalibrationResult whole = calibrated(*knee_, resumed);
  EXPECT_TRUE(whole.fit.converged);
  EXPECT_LT((whole.fit.theta - result_->fit.theta).norm(), 1e-5);
}

}  // namespace
}  // namespace condyle::test
