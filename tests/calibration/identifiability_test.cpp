/// What data and prior determine: closed covariances, ranks below full, parameters at bounds.

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "condyle/calibration/identifiability.h"
#include "support/random_matrix.h"

namespace condyle::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd closed_covariance(const MatrixXd& J, const VectorXd& weight, const VectorXd& prior_sd) {
  const MatrixXd WJ = weight.asDiagonal() * J;
  const VectorXd prior = prior_sd.cwiseAbs2().cwiseInverse();
  return (WJ.transpose() * WJ + MatrixXd(prior.asDiagonal())).inverse();
}

TEST(Identifiability, CovarianceIsTheInverseOfThePrecision) {
  const MatrixXd J = random_matrix(30, 4, 1);
  const VectorXd weight = VectorXd::LinSpaced(30, 0.2, 2);
  const VectorXd prior_sd = VectorXd::LinSpaced(4, 0.03, 2);
  const Identifiability known = identifiability(J, weight, prior_sd, std::vector<bool>(4, false));
  const MatrixXd expected = closed_covariance(J, weight, prior_sd);
  EXPECT_TRUE(known.covariance.isApprox(expected, 1e-12));
  EXPECT_TRUE(known.sd.isApprox(expected.diagonal().cwiseSqrt(), 1e-12));
  EXPECT_TRUE(
      (known.directions.transpose() * known.directions).isApprox(MatrixXd::Identity(4, 4), 1e-13));
  // tr(S (SᵀS + 1)⁻¹ Sᵀ), the trace of the hat matrix
  const MatrixXd S = weight.asDiagonal() * J * prior_sd.asDiagonal();
  const MatrixXd hat = S * (S.transpose() * S + MatrixXd::Identity(4, 4)).inverse() * S.transpose();
  EXPECT_NEAR(known.effective, hat.trace(), 1e-12);
}

TEST(Identifiability, SingularValuesAreSignalOverNoise) {
  // One datum of sd 0.1 for each of two parameters with prior sds of 1 and 0.01.
  const Identifiability known = identifiability(MatrixXd::Identity(2, 2), VectorXd::Constant(2, 10),
                                                Eigen::Vector2d(0.01, 1), {false, false});
  EXPECT_NEAR(known.singular_values[0], 10, 1e-12);
  EXPECT_NEAR(known.singular_values[1], 0.1, 1e-12);
  EXPECT_NEAR(std::abs(known.directions(1, 0)), 1, 1e-12);
  EXPECT_EQ(known.determined, 1);
  EXPECT_NEAR(known.sd[1], 1 / std::sqrt(101), 1e-12);
  EXPECT_NEAR(known.sd[0], 0.01 / std::sqrt(1.01), 1e-12);
}

TEST(Identifiability, FewerDataThanParametersLeaveThePriorInTheRest) {
  const MatrixXd J = random_matrix(2, 5, 3);
  const VectorXd prior_sd = VectorXd::LinSpaced(5, 0.5, 3);
  const VectorXd weight = VectorXd::Constant(2, 100);
  const Identifiability known = identifiability(J, weight, prior_sd, std::vector<bool>(5, false));
  EXPECT_EQ(known.singular_values.size(), 5);
  EXPECT_EQ(known.determined, 2);
  EXPECT_EQ(known.singular_values.tail(3), VectorXd::Zero(3));
  EXPECT_TRUE(known.covariance.isApprox(closed_covariance(J, weight, prior_sd), 1e-9));
  // Along a direction that the data do not see the posterior is the prior.
  const VectorXd blind = known.directions.col(4);
  const MatrixXd P_inverse = prior_sd.cwiseInverse().asDiagonal();
  EXPECT_NEAR(blind.dot(P_inverse * known.covariance * P_inverse * blind), 1, 1e-12);
}

TEST(Identifiability, AParameterThatNoDatumSeesKeepsItsPriorHoweverWide) {
  MatrixXd J = random_matrix(10, 3, 4);
  J.col(1).setZero();
  const Identifiability known =
      identifiability(J, VectorXd::Ones(10), VectorXd::Constant(3, 1e8), {false, false, false});
  EXPECT_NEAR(known.sd[1], 1e8, 1);
  EXPECT_LT(known.sd[0], 1);
  EXPECT_NEAR(known.effective, 2, 1e-12);
}

TEST(Identifiability, AParameterAtItsBoundIsKnown) {
  const MatrixXd J = random_matrix(12, 3, 5);
  const VectorXd weight = VectorXd::Ones(12), prior_sd = VectorXd::Constant(3, 2);
  const Identifiability known = identifiability(J, weight, prior_sd, {false, true, false});
  EXPECT_EQ(known.sd[1], 0);
  EXPECT_EQ(known.covariance.row(1).norm() + known.covariance.col(1).norm(), 0);
  MatrixXd others(12, 2);
  others << J.col(0), J.col(2);
  const MatrixXd expected = closed_covariance(others, weight, VectorXd::Constant(2, 2));
  EXPECT_NEAR(known.covariance(0, 2), expected(0, 1), 1e-12);
  EXPECT_NEAR(known.sd[2], std::sqrt(expected(1, 1)), 1e-12);
  EXPECT_EQ(known.singular_values[2], 0);
  EXPECT_EQ(known.directions.col(2), VectorXd(Eigen::Vector3d(0, 1, 0)));
}

TEST(Information, IsThatOfThePosteriorWithTheNewRowsToo) {
  const MatrixXd J = random_matrix(12, 3, 8), more = random_matrix(2, 3, 9);
  const VectorXd prior_sd = Eigen::Vector3d(0.03, 2, 1), weight = Eigen::Vector2d(2, 0.5);
  const std::vector<bool> none(3, false);
  const Identifiability before = identifiability(J, VectorXd::Ones(12), prior_sd, none);
  const Information told = information_of(more, weight, before.covariance);
  MatrixXd all(14, 3);
  all << J, weight.asDiagonal() * more;
  const Identifiability after = identifiability(all, VectorXd::Ones(14), prior_sd, none);
  EXPECT_TRUE(told.covariance.isApprox(after.covariance, 1e-10));
  EXPECT_NEAR(told.nats,
              0.5 * std::log(before.covariance.determinant() / after.covariance.determinant()),
              1e-10);
}

}  // namespace
}  // namespace condyle::test
