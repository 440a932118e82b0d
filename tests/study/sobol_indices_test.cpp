#include "condyle/study/sobol_indices.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "condyle/design/uniform_draws.h"
#include "study/missing.h"
#include "study/saltelli_values.h"

namespace condyle {
namespace {

bool holds(const IndexEstimate& estimate, double value) {
  return estimate.lower <= value && value <= estimate.upper;
}

TEST(SobolIndices, OfIshigamisFunctionAreWithinTheirIntervals) {
  const IshigamiIndices closed;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const std::vector<double> y = saltelli_values(3, 4096, seed, ishigami);
    const SobolIndices indices = sobol_indices(y.data(), 4096, 3, 1);
    EXPECT_EQ(indices.points, 4096);
    EXPECT_NEAR(indices.mean, 3.5, 0.01);          // a/2
    EXPECT_NEAR(indices.variance, 13.8446, 0.05);  // a²/8 + bπ⁴/5 + b²π⁸/18 + 1/2
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_TRUE(holds(indices.first[j], closed.first[j])) << seed << " " << j;
      EXPECT_TRUE(holds(indices.total[j], closed.total[j])) << seed << " " << j;
      EXPECT_LT(indices.first[j].upper - indices.first[j].lower, 0.1);
      EXPECT_LT(indices.total[j].upper - indices.total[j].lower, 0.1);
    }
  }
}

// y = 3 x₁ + 2 x₂ + x₃ of independent points: both indices are 9/14, 4/14, 1/14. Of 200 intervals of 95 %
// 190 hold the value, with a deviation of 3.1.
TEST(SobolIndices, IntervalsHoldTheValueAsOftenAsTheySay) {
  const std::array weights = {3., 2., 1.};
  std::array<int, 3> first{}, total{};
  const std::size_t n = 256;
  std::vector<double> ab(6), y(5 * n);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    for (std::size_t i = 0; i < n; ++i) {
      uniform_draws(seed, 77, i, ab);
      double a = 0, b = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        a += weights[j] * ab[j];
        b += weights[j] * ab[3 + j];
      }
      y[5 * i] = a;
      y[5 * i + 1] = b;
      for (std::size_t j = 0; j < 3; ++j) y[5 * i + 2 + j] = a + weights[j] * (ab[3 + j] - ab[j]);
    }
    const SobolIndices indices = sobol_indices(y.data(), n, 3, 1);
    for (std::size_t j = 0; j < 3; ++j) {
      const double closed = weights[j] * weights[j] / 14;
      first[j] += holds(indices.first[j], closed);
      total[j] += holds(indices.total[j], closed);
    }
  }
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_GE(first[j], 180) << j;
    EXPECT_LE(first[j], 198) << j;
    EXPECT_GE(total[j], 180) << j;
    EXPECT_LE(total[j], 198) << j;
  }
}

// What one parameter alone decides is told exactly, whatever the points.
TEST(SobolIndices, OfOneParametersFunctionAreExact) {
  const std::vector<double> y =
      saltelli_values(3, 16, 1, [](const auto& u) { return std::exp(u[1]); });
  const SobolIndices indices = sobol_indices(y.data(), 16, 3, 1);
  EXPECT_NEAR(indices.first[1].value, 1, 1e-15);
  EXPECT_NEAR(indices.first[1].lower, 1, 1e-15);
  for (const std::size_t j : {0u, 2u}) {
    EXPECT_EQ(indices.total[j].value, 0);
    EXPECT_EQ(indices.total[j].upper, 0);
  }
}

TEST(SobolIndices, DoNotDependOnOffsetAndUnit) {
  const std::vector<double> y = saltelli_values(3, 64, 1, ishigami);
  std::vector<double> other = y;
  for (double& value : other) value = 1e4 - 1e-3 * value;
  const SobolIndices a = sobol_indices(y.data(), 64, 3, 1);
  const SobolIndices b = sobol_indices(other.data(), 64, 3, 1);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(a.first[j].lower, b.first[j].lower, 1e-8);
    EXPECT_NEAR(a.total[j].upper, b.total[j].upper, 1e-8);
  }
}

TEST(SobolIndices, OfWhatDoesNotVaryAreNone) {
  const std::vector<double> same(5 * 100, 12.5);
  EXPECT_TRUE(std::isnan(sobol_indices(same.data(), 100, 3, 1).first[0].value));
  std::vector<double> noise = saltelli_values(3, 100, 1, ishigami);
  for (double& value : noise) value = 12.5 + 1e-11 * value;
  const SobolIndices indices = sobol_indices(noise.data(), 100, 3, 1);
  EXPECT_TRUE(std::isnan(indices.first[1].value));
  EXPECT_TRUE(std::isnan(indices.total[1].upper));
  EXPECT_NEAR(indices.mean, 12.5, 1e-9);
}

TEST(SobolIndices, OfThreeBasePointsAreNone) {
  const std::vector<double> y = saltelli_values(3, 4, 1, ishigami);
  EXPECT_TRUE(std::isnan(sobol_indices(y.data(), 3, 3, 1).total[0].value));
  EXPECT_FALSE(std::isnan(sobol_indices(y.data(), 4, 3, 1).total[0].value));
  EXPECT_TRUE(std::isnan(sobol_indices(y.data(), 0, 3, 1).mean));
}

// A missing value, in whichever block, takes its whole base point with it and nothing else.
TEST(SobolIndices, LeaveOutBasePointsThatAreNotComplete) {
  const std::size_t n = 200;
  const std::vector<double> y = saltelli_values(3, n, 5, ishigami);
  std::vector<double> holes = y, complete;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 7 == 3)
      holes[5 * i + i % 5] = kMissing;
    else
      complete.insert(complete.end(), &y[5 * i], &y[5 * i] + 5);
  }
  const SobolIndices a = sobol_indices(holes.data(), n, 3, 1);
  const SobolIndices b = sobol_indices(complete.data(), complete.size() / 5, 3, 1);
  EXPECT_EQ(a.points, static_cast<long>(complete.size() / 5));
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(a.first[j].value, b.first[j].value);
    EXPECT_EQ(a.total[j].lower, b.total[j].lower);
  }
}

TEST(SobolIndices, ReadValuesAStrideApart) {
  const std::vector<double> y = saltelli_values(3, 50, 5, ishigami);
  std::vector<double> wide(4 * y.size(), kMissing);
  for (std::size_t k = 0; k < y.size(); ++k) wide[4 * k + 2] = y[k];
  EXPECT_EQ(sobol_indices(wide.data() + 2, 50, 3, 4).first[1].value,
            sobol_indices(y.data(), 50, 3, 1).first[1].value);
}

}  // namespace
}  // namespace condyle
