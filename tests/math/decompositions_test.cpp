#include "condyle/math/decompositions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle {
namespace {

constexpr double kExactly = 1e-14;

/// Two rows say the same, and the last column counts for nothing.
Eigen::MatrixXd deficient() { return Eigen::MatrixXd{{1, 2, 0}, {2, 4, 0}, {0, 1, 0}}; }

TEST(Decompositions, TheLeastNormSolutionIsTheShortestThatComesNearest) {
  const LeastNormSolution found = least_norm_solution(deficient(), Eigen::Vector3d(1, 2, 1));
  EXPECT_EQ(found.rank, 2);
  EXPECT_LT((found.x - Eigen::Vector3d(-1, 1, 0)).norm(), kExactly);
  // What the rows contradict each other by is shared: 5 a + 10 b = 1 + 2 * 3.
  const LeastNormSolution nearest = least_norm_solution(deficient(), Eigen::Vector3d(1, 3, 0));
  EXPECT_LT((nearest.x - Eigen::Vector3d(1.4, 0, 0)).norm(), kExactly);
}

TEST(Decompositions, APivotUpToTheThresholdCountsAsNothing) {
  const Eigen::MatrixXd A{{1, 0}, {0, 1e-8}};
  EXPECT_EQ(least_norm_solution(A, Eigen::Vector2d(1, 1)).rank, 2);
  const LeastNormSolution found = least_norm_solution(A, Eigen::Vector2d(1, 1), 1e-6);
  EXPECT_EQ(found.rank, 1);
  EXPECT_LT((found.x - Eigen::Vector2d(1, 0)).norm(), kExactly);
}

TEST(Decompositions, TheOrthogonalFactorIsSquareAndBeginsWithTheColumns) {
  const Eigen::MatrixXd A{{3, 0}, {4, 0}, {0, 2}};
  const Eigen::MatrixXd Q = orthogonal_factor(A);
  ASSERT_EQ(Q.rows(), 3);
  ASSERT_EQ(Q.cols(), 3);
  EXPECT_LT((Q.transpose() * Q - Eigen::Matrix3d::Identity()).norm(), kExactly);
  EXPECT_LT((Q.col(2).transpose() * A).norm(), kExactly);
}

TEST(Decompositions, ThePivotedBasisLeavesWhatDependentColumnsDoNotReach) {
  const PivotedBasis basis = pivoted_basis(SmallMatrix(deficient().transpose()), 1e-9);
  EXPECT_EQ(basis.rank, 2);
  ASSERT_EQ(basis.Q.cols(), 3);
  EXPECT_LT((deficient() * basis.Q.col(2)).norm(), kExactly);
  EXPECT_EQ(pivoted_basis(SmallMatrix{{1, 0}, {0, 1e-10}}, 1e-9).rank, 1);
}

TEST(Decompositions, ThePivotedBasisTakesTheLongestColumnFirst) {
  const PivotedBasis basis = pivoted_basis(SmallMatrix{{1, 0, 0}, {0, 3, 2}}, 0);
  EXPECT_EQ(basis.order[0], 1);
  EXPECT_EQ(basis.order[1], 0);  // nothing is left of the third
}

TEST(Decompositions, SingularValuesHaveAColumnForWhatTheMatrixDoesNotSee) {
  const Eigen::MatrixXd A{{3, 0, 0}, {0, 2, 0}};
  const SingularValues found = singular_values(A);
  ASSERT_EQ(found.values.size(), 2);
  EXPECT_LT((found.values - Eigen::Vector2d(3, 2)).norm(), kExactly);
  ASSERT_EQ(found.V.cols(), 3);
  EXPECT_LT((A * found.V.col(2)).norm(), kExactly);
}

TEST(Decompositions, EigenvaluesComeTheLeastFirst) {
  const SymmetricEigenvalues found = symmetric_eigenvalues(SmallMatrix{{2, 1}, {1, 2}});
  EXPECT_LT((found.values - Eigen::Vector2d(1, 3)).norm(), kExactly);
  EXPECT_NEAR(found.vectors(0, 0), -found.vectors(1, 0), kExactly);
}

TEST(Decompositions, EigenvaluesOfThePlaneAreThoseOfTheGeneralWay) {
  for (const Eigen::Matrix2d& A :
       {Eigen::Matrix2d{{2, 1}, {1, 2}}, Eigen::Matrix2d{{-3, 0.5}, {0.5, 7}},
        Eigen::Matrix2d{{4, 0}, {0, 4}}, Eigen::Matrix2d{{1, 1e-9}, {1e-9, 1}}}) {
    const PlaneEigenvalues found = plane_eigenvalues(A);
    EXPECT_LT((found.values - Eigen::Vector2d(symmetric_eigenvalues(A).values)).norm(), kExactly);
    EXPECT_LT((A * found.vectors - found.vectors * found.values.asDiagonal()).norm(), kExactly);
    EXPECT_LT((found.vectors.transpose() * found.vectors - Eigen::Matrix2d::Identity()).norm(),
              kExactly);
  }
}

TEST(Decompositions, NormalEquationsAreSolvedByTheirSymmetry) {
  const Eigen::MatrixXd A{{4, 2, 0}, {2, 5, 1}, {0, 1, 3}}, X{{1, 0}, {-2, 3}, {0.5, 1}};
  EXPECT_LT((symmetric_solution(A, A * X) - X).norm(), kExactly);
}

TEST(Decompositions, OnlyWhatIsRegularHasAnInverse) {
  const SmallMatrix A{{0, 2}, {1, 1}};
  const std::optional<SmallMatrix> inverse = regular_inverse(A, 1e-9);
  ASSERT_TRUE(inverse);
  EXPECT_LT((A * *inverse - Eigen::Matrix2d::Identity()).norm(), kExactly);
  EXPECT_FALSE(regular_inverse(SmallMatrix{{1, 2}, {2, 4}}, 1e-9));
  EXPECT_FALSE(regular_inverse(SmallMatrix{{1, 0}, {0, 1e-10}}, 1e-9));
  EXPECT_FALSE(regular_inverse(SmallMatrix{{1, 0}, {0, std::nan("")}}, 1e-9));
}

TEST(Decompositions, SolutionsSolve) {
  const Eigen::MatrixXd A{{0, 2}, {1, 1}};
  EXPECT_LT((partially_pivoted_solution(A, Eigen::Vector2d(2, 3)) - Eigen::Vector2d(2, 1)).norm(),
            kExactly);
  EXPECT_LT(
      (A * fully_pivoted_solution(A, Eigen::Matrix2d::Identity()) - Eigen::Matrix2d::Identity())
          .norm(),
      kExactly);
}

TEST(Decompositions, WhatDependentColumnsSayTwiceCountsOnce) {
  // Of (3, 1, 0) the part along (1, 2, 0) is (1, 2, 0), the third axis takes all of 7.
  EXPECT_NEAR(square_along(deficient(), Eigen::Vector3d(3, 1, 7)), 5 + 49, 54 * kExactly);
}

TEST(Decompositions, TheLowerRootIsATriangle) {
  const Eigen::MatrixXd A{{4, 2, 0}, {2, 5, 1}, {0, 1, 3}}, L = lower_root(A);
  EXPECT_LT((L * L.transpose() - A).norm(), kExactly);
  EXPECT_EQ(L(0, 1), 0);
  EXPECT_LT((L * lower_solution(L, A) - A).norm(), 4 * kExactly);
}

}  // namespace
}  // namespace condyle
