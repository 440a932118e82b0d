#include "condyle/design/spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace condyle {
namespace {

using Kind = Spread::Kind;

double cdf(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }
double density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi); }

// The distribution function of the quantile is u again; of small u relatively.
TEST(Spread, QuantileOfANormalNumberInvertsItsDistribution) {
  const Spread spread{.sd = 2.5};
  for (const double u : {1e-300, 1e-100, 1e-16, 1e-5, 0.1, 0.3, 0.5, 0.77}) {
    const double z = quantile(spread, u) / 2.5;
    // d ln(cdf)/dz is about |z| in the tail, and z is known to its last digit.
    EXPECT_NEAR(cdf(z) / u, 1, 1e-15 * (20 + 5 * z * z)) << u;
  }
  EXPECT_EQ(quantile(spread, 0.5), 0);
  EXPECT_EQ(quantile(spread, 0x1p-53), -quantile(spread, 1 - 0x1p-53));
  EXPECT_EQ(quantile(spread, 0.25), -quantile(spread, 0.75));
}

// Given a < Z < b, P(Z < quantile(u)) = cdf(a) + u (cdf(b) - cdf(a)).
TEST(Spread, QuantileOfACutNormalNumberInvertsItsDistribution) {
  for (const auto& [a, b] : {std::array{-1., 2.}, {-3., -1.}, {0., 4.}, {-0.1, 0.1}, {-1e300, 1.}})
    for (const double u : {1e-9, 0.01, 0.3, 0.5, 0.9, 0.999}) {
      const double z = quantile({.sd = 1, .bounds = {a, b}}, u);
      EXPECT_NEAR((cdf(z) - cdf(a)) / (cdf(b) - cdf(a)), u, 1e-14 / (cdf(b) - cdf(a)));
      EXPECT_GT(z, a);
      EXPECT_LT(z, b);
    }
}

// Beyond eight deviations the difference of distribution functions would hold no digit: the tail is
// nearly exponential, P(Z > a + t) / P(Z > a) told by erfc.
TEST(Spread, QuantileIsAccurateInATail) {
  for (const double a : {8., 20., 36.})
    for (const double u : {0.1, 0.5, 0.99}) {
      const double z = quantile({.sd = 3, .bounds = {3 * a, 1e300}}, u) / 3;
      EXPECT_NEAR(cdf(-z) / cdf(-a), 1 - u, 1e-12) << a;
      EXPECT_NEAR(quantile({.sd = 3, .bounds = {-1e300, -3 * a}}, 1 - u), -3 * z, 1e-12);
    }
}

TEST(Spread, WhatHoldsNoProbabilityStandsAtTheBoundNextToTheMean) {
  EXPECT_EQ(quantile({.sd = 1, .bounds = {50, 60}}, 0.3), 50);
  EXPECT_EQ(quantile({.sd = 1, .bounds = {-60, -50}}, 0.3), -50);
  EXPECT_EQ(quantile({.sd = 1, .bounds = {2, 2}}, 0.3), 2);
}

// Mean and variance of a standard normal number given -1 < Z < 2, in closed form [Johnson 1994]; by
// the midpoint rule over u, whose error is of second order where the quantile is smooth.
TEST(Spread, MomentsOfACutNormalNumber) {
  const double a = -1, b = 2, mass = cdf(b) - cdf(a);
  const double mean = (density(a) - density(b)) / mass;
  const double variance = 1 + (a * density(a) - b * density(b)) / mass - mean * mean;
  const int n = 100000;
  double sum = 0, squares = 0;
  for (int k = 0; k < n; ++k) {
    const double z = quantile({.sd = 1, .bounds = {a, b}}, (k + 0.5) / n);
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / n, mean, 1e-8);
  EXPECT_NEAR(squares / n - sum / n * sum / n, variance, 1e-8);
}

TEST(Spread, UniformAndBits) {
  EXPECT_EQ(quantile({.kind = Kind::kUniform, .bounds = {-2, 6}}, 0.25), 0);
  EXPECT_LE(quantile({.kind = Kind::kUniform, .bounds = {-0.1, 0.3}}, 1 - 0x1p-53), 0.3);
  EXPECT_EQ(quantile({.kind = Kind::kBits}, 0.123), 0.123);
}

}  // namespace
}  // namespace condyle
