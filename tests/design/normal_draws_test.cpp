#include "condyle/design/normal_draws.h"

#include <gtest/gtest.h>

namespace condyle {
namespace {

TEST(NormalDraws, AreAFunctionOfWhereTheyStand) {
  const Eigen::VectorXd five = normal_draws(7, DrawsFor::kStart, 3, 5);
  EXPECT_EQ(five, normal_draws(7, DrawsFor::kStart, 3, 9).head(5));
  EXPECT_NE(five, normal_draws(7, DrawsFor::kNoise, 3, 5));
  EXPECT_NE(five, normal_draws(8, DrawsFor::kStart, 3, 5));
  EXPECT_NE(five, normal_draws(7, DrawsFor::kStart, 4, 5));
}

}  // namespace
}  // namespace condyle
