/// Starts, samples and profiles on problems whose posterior is known in closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "condyle/calibration/agreement.h"
#include "condyle/calibration/multi_start.h"
#include "condyle/calibration/posterior_samples.h"
#include "condyle/calibration/profiles.h"
#include "condyle/design/normal_draws.h"
#include "support/random_matrix.h"

namespace condyle::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rows with that evaluation, sd 1, priors as given, no bounds.
FitProblem problem_of(const Evaluate& evaluate, const VectorXd& d, const VectorXd& prior_sd) {
  FitProblem problem;
  const Eigen::Index n = prior_sd.size();
  problem.rows.d = d;
  problem.rows.sd = VectorXd::Ones(d.size());
  problem.rows.prior_sd = prior_sd;
  problem.rows.prior_mean = VectorXd::Zero(n);
  problem.rows.lower = VectorXd::Constant(n, -1e300);
  problem.rows.upper = VectorXd::Constant(n, 1e300);
  problem.make_worker = [evaluate] { return FitWorker{evaluate, [] {}}; };
  return problem;
}

Evaluate linear(const MatrixXd& A) {
  return [A](const VectorXd& theta, VectorXd& y, MatrixXd* J) {
    y = A * theta;
    if (J != nullptr) *J = A;
    return true;
  };
}

/// Three parameters of very different scale, twelve rows.
struct LinearCase {
  MatrixXd A = random_matrix(12, 3, 1) * Eigen::Vector3d(30, 1, 0.3).asDiagonal();
  VectorXd prior_sd = Eigen::Vector3d(0.03, 2, 1);
  FitProblem problem = problem_of(linear(A), random_matrix(12, 1, 2), prior_sd);
  StudyProgress progress{nullptr};
  LeastSquaresResult least =
      fit_by(problem.make_worker(), problem.rows, VectorXd::Zero(3), progress);
  Identifiability known =
      identifiability(A, VectorXd::Ones(12), prior_sd, std::vector<bool>(3, false));
};

TEST(NormalDraws, AreStandardNormalAndBelongToTheirPlace) {
  const VectorXd draws = normal_draws(1, DrawsFor::kNoise, 7, 100000);
  // Of 1e5 numbers the mean has an sd of 0.0032, the variance of 0.0045, the fourth moment of 0.031.
  EXPECT_NEAR(draws.mean(), 0, 0.013);
  EXPECT_NEAR(draws.squaredNorm() / 1e5, 1, 0.018);
  EXPECT_NEAR(draws.array().pow(4).mean(), 3, 0.12);
  EXPECT_EQ(VectorXd(draws.head(10)), normal_draws(1, DrawsFor::kNoise, 7, 10));
  for (const VectorXd& other :
       {normal_draws(2, DrawsFor::kNoise, 7, 100000), normal_draws(1, DrawsFor::kStart, 7, 100000),
        normal_draws(1, DrawsFor::kNoise, 8, 100000)})
    EXPECT_NEAR(draws.dot(other) / 1e5, 0, 0.013);
}

TEST(InParallel, DoesEveryTaskOnceAndStopsAtAWordOrAnError) {
  std::vector<int> done(100, 0);
  StudyProgress free(nullptr);
  EXPECT_TRUE(in_parallel(
      "", 100, 3, [&] { return [&](int k) { ++done[static_cast<std::size_t>(k)]; }; }, free));
  EXPECT_EQ(std::count(done.begin(), done.end(), 1), 100);

  StudyProgress after_ten([](const std::string& stage, int number, int total) {
    EXPECT_EQ(stage, "tasks");
    EXPECT_EQ(total, 100);
    return number < 10;
  });
  std::atomic<int> begun = 0;
  EXPECT_FALSE(in_parallel(
      "tasks", 100, 2, [&] { return [&](int) { ++begun; }; }, after_ten));
  EXPECT_TRUE(after_ten.stopped());
  EXPECT_LE(begun, 11);

  StudyProgress other(nullptr);
  const auto fails = [] {
    return [](int k) {
      if (k == 3) throw std::runtime_error("three");
    };
  };
  EXPECT_THROW(in_parallel("", 100, 2, fails, other), std::runtime_error);
}

TEST(PosteriorSamples, OfALinearProblemHaveItsPosteriorCovariance) {
  LinearCase linear_case;
  const int count = 4000;
  const PosteriorSamples samples = posterior_samples(linear_case.problem, linear_case.least.theta,
                                                     count, 1, linear_case.progress);
  ASSERT_EQ(samples.theta.rows(), count);
  EXPECT_EQ(samples.lost, 0);
  const MatrixXd& C = linear_case.known.covariance;
  const VectorXd mean = samples.theta.colwise().mean();
  const MatrixXd off = samples.theta.rowwise() - mean.transpose();
  const MatrixXd found = off.transpose() * off / (count - 1);
  for (int i = 0; i < 3; ++i) {
    const double sd = std::sqrt(C(i, i));
    EXPECT_NEAR(mean[i], linear_case.least.theta[i], 4 * sd / std::sqrt(count));
    EXPECT_NEAR(samples.sd[i] / sd, 1, 4 / std::sqrt(2. * count));
    for (int j = 0; j < i; ++j)  // sd of a sampled correlation is at most 1/√n
      EXPECT_NEAR((found(i, j) - C(i, j)) / (sd * std::sqrt(C(j, j))), 0, 4 / std::sqrt(count));
  }
}

TEST(PosteriorSamples, AreTheSameBitsOnAnyNumberOfThreads) {
  LinearCase linear_case;
  const auto samples = [&](int threads) {
    linear_case.problem.threads = threads;
    return posterior_samples(linear_case.problem, linear_case.least.theta, 50, 3,
                             linear_case.progress)
        .theta;
  };
  const MatrixXd one = samples(1);
  EXPECT_EQ(one, samples(2));
  EXPECT_EQ(one, samples(3));
}

TEST(PosteriorSamples, ThoseBeyondAWallAreCountedAsLost) {
  // Posterior of θ is N(0, 1/2); there is no pose from 0.5 on, so a sample above it is lost: 24 %.
  const Evaluate walled = [](const VectorXd& theta, VectorXd& y, MatrixXd* J) {
    y = theta;
    if (J != nullptr) *J = MatrixXd::Identity(1, 1);
    return theta[0] < 0.5;
  };
  const FitProblem problem = problem_of(walled, VectorXd::Zero(1), VectorXd::Ones(1));
  StudyProgress progress(nullptr);
  const PosteriorSamples samples = posterior_samples(problem, VectorXd::Zero(1), 400, 1, progress);
  EXPECT_EQ(samples.theta.rows() + samples.lost, 400);
  EXPECT_NEAR(samples.lost / 400., 0.24, 0.085);  // 4 binomial sds
}

TEST(Profiles, OfALinearProblemAreParabolasOfThePosteriorSd) {
  LinearCase linear_case;
  const std::vector<Profile> profiles = find_profiles(linear_case.problem, linear_case.least,
                                                      linear_case.known, 12, linear_case.progress);
  ASSERT_EQ(profiles.size(), 3U);
  for (const Profile& profile : profiles) {
    const auto j = static_cast<Eigen::Index>(profile.parameter);
    ASSERT_EQ(profile.theta.size(), 20U);
    for (std::size_t k = 0; k < 20; ++k) {
      const double sds = (profile.theta[k] - linear_case.least.theta[j]) / linear_case.known.sd[j];
      EXPECT_NEAR(profile.chi_square[k], sds * sds, 1e-6);
    }
    EXPECT_NEAR(profile.chi_square.front(), 9, 1e-6);
  }
}

TEST(Profiles, AreThoseOfTheBestKnownAndOfNoneAtABound) {
  LinearCase linear_case;
  linear_case.known.sd[1] = 0;  // at its bound
  const VectorXd kept = linear_case.known.sd.cwiseQuotient(linear_case.prior_sd);
  const std::vector<Profile> profiles = find_profiles(linear_case.problem, linear_case.least,
                                                      linear_case.known, 1, linear_case.progress);
  ASSERT_EQ(profiles.size(), 1U);
  EXPECT_EQ(profiles[0].parameter, kept[0] < kept[2] ? 0U : 2U);
}

/// Two leasts near -1 and 1, the right one deeper; poses only for |θ| < 3.
FitProblem two_valleys() {
  const Evaluate evaluate = [](const VectorXd& theta, VectorXd& y, MatrixXd* J) {
    const double t = theta[0];
    y = Eigen::Vector2d(10 * (t * t - 1), 0.3 * (t - 1));
    if (J != nullptr) *J = (MatrixXd(2, 1) << 20 * t, 0.3).finished();
    return std::abs(t) < 3;
  };
  return problem_of(evaluate, VectorXd::Zero(2), VectorXd::Constant(1, 2));
}

TEST(MultiStart, FindsBothValleysFromWhereverPosesAre) {
  const FitProblem problem = two_valleys();
  StudyProgress progress(nullptr);
  double least = 1e300;
  const auto fits = fit_from_prior(
      problem, 33, 1, [&](const VectorXd&, double cost) { least = std::min(least, cost); },
      progress);
  ASSERT_EQ(fits.size(), 32U);
  int left = 0;
  for (const LeastSquaresResult& fit : fits) {
    ASSERT_EQ(fit.theta.size(), 1);
    EXPECT_TRUE(fit.converged) << fit.message;
    EXPECT_NEAR(std::abs(fit.theta[0]), 1, 0.01);
    left += fit.theta[0] < 0;
    EXPECT_GE(fit.cost, least);
  }
  EXPECT_GT(left, 4);
  EXPECT_LT(left, 28);
}

TEST(Reach, GoesInPartsWhereAWholeStepLosesThePoses) {
  // Poses are followed: a step of more than 0.3 from the last one finds none.
  double last = 0;
  FitWorker worker;
  worker.reset = [&] { last = 0; };
  worker.evaluate = [&](const VectorXd& theta, VectorXd& y, MatrixXd*) {
    y = theta;
    if (std::abs(theta[0] - last) > 0.3 || theta[0] > 2) return false;
    last = theta[0];
    return true;
  };
  EXPECT_TRUE(reach(worker, VectorXd::Constant(1, 1.7)));
  EXPECT_EQ(last, 1.7);
  EXPECT_FALSE(reach(worker, VectorXd::Constant(1, 2.5)));
  EXPECT_NEAR(nearest_start(worker, VectorXd::Constant(1, 1.6))[0], 0.2, 1e-15);
}

TEST(Agreement, LimitOfChiSquareIsThatOfTables) {
  // 97.5 % quantiles: χ²(1) 5.0239, χ²(10) 20.4832, χ²(313) 363.88 by their series
  EXPECT_NEAR(reduced_chi_square_limit(1), 5.0239, 0.1);
  EXPECT_NEAR(reduced_chi_square_limit(10), 2.04832, 0.001 * 2.05);
  EXPECT_NEAR(reduced_chi_square_limit(100), 129.561 / 100, 0.0003);
  EXPECT_TRUE(std::isnan(reduced_chi_square_limit(0)));
  EXPECT_TRUE(std::isnan(reduced_chi_square_limit(0.3)));  // less than one row is left over
}

}  // namespace
}  // namespace condyle::test
