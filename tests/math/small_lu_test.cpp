#include "condyle/math/small_lu.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>

namespace condyle {
namespace {

TEST(SmallLu, SolvesWhatEigenSolves) {
  for (int n = 1; n <= SmallLu::kMaxSize; ++n) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n);
    const Eigen::VectorXd b = Eigen::VectorXd::Random(n);
    SmallLu lu;
    double x[SmallLu::kMaxSize];
    for (int i = 0; i < n; ++i) {
      x[i] = b[i];
      for (int j = 0; j < n; ++j) lu(i, j) = A(i, j);
    }
    ASSERT_TRUE(lu.factor(n));
    double transposed[SmallLu::kMaxSize];
    std::copy(x, x + n, transposed);
    lu.solve(x);
    lu.solve_transposed(transposed);
    const Eigen::VectorXd expected = A.fullPivLu().solve(b);
    const Eigen::VectorXd of_transposed = A.transpose().fullPivLu().solve(b);
    EXPECT_LT((Eigen::Map<Eigen::VectorXd>(x, n) - expected).norm(), 1e-9 * (1 + expected.norm()))
        << n;
    EXPECT_LT((Eigen::Map<Eigen::VectorXd>(transposed, n) - of_transposed).norm(),
              1e-9 * (1 + of_transposed.norm()))
        << n;
  }
}

TEST(SmallLu, NeedsARowSwapWhereTheFirstPivotIsZero) {
  SmallLu lu;
  lu(0, 0) = 0, lu(0, 1) = 2, lu(1, 0) = 3, lu(1, 1) = 1;
  double x[2] = {4, 5};  // 2 y = 4, 3 x + y = 5
  ASSERT_TRUE(lu.factor(2));
  lu.solve(x);
  EXPECT_DOUBLE_EQ(x[0], 1);
  EXPECT_DOUBLE_EQ(x[1], 2);
}

TEST(SmallLu, DependentRowsAreSingular) {
  SmallLu lu;
  lu(0, 0) = 1, lu(0, 1) = 2, lu(1, 0) = 2, lu(1, 1) = 4;
  EXPECT_FALSE(lu.factor(2));
}

}  // namespace
}  // namespace condyle
