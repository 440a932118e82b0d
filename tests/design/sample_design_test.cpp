#include "condyle/design/sample_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <thread>

#include "condyle/design/permutation.h"
#include "condyle/design/random_bits.h"
#include "condyle/design/sobol_points.h"
#include "condyle/design/uniform_draws.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

using Points = std::vector<std::vector<double>>;

Points all_points(const SampleDesign& design) {
  Points points(design.size());
  for (std::uint64_t k = 0; k < design.size(); ++k) design.point(k, points[k]);
  return points;
}

const std::array kKinds = {DesignKind::kMonteCarlo, DesignKind::kLatinHypercube, DesignKind::kSobol,
                           DesignKind::kSaltelli, DesignKind::kGrid};

std::string error_of(const DesignOptions& options) {
  try {
    const SampleDesign design(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SampleDesign, APointIsTheSameInAnyOrderAndFromAnyThread) {
  for (const DesignKind kind : kKinds) {
    const SampleDesign design({.kind = kind, .dimensions = 5, .points = 100, .seed = 9});
    const Points forward = all_points(design);
    Points by_threads(forward.size());
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (std::size_t k = by_threads.size(); k-- > 0;)
          if (k % 4 == t) design.point(k, by_threads[k]);
      });
    threads.clear();
    EXPECT_EQ(forward, by_threads);
    for (const std::vector<double>& u : forward)
      for (const double c : u) EXPECT_TRUE(c > 0 && c < 1);
  }
}

TEST(SampleDesign, AnotherSeedIsAnotherDesign) {
  for (const DesignKind kind : kKinds) {
    if (kind == DesignKind::kGrid) continue;
    const DesignOptions options{.kind = kind, .dimensions = 3, .points = 40, .seed = 1};
    DesignOptions other = options;
    other.seed = 2;
    const Points a = all_points(SampleDesign(options)), b = all_points(SampleDesign(other));
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NE(a[k], b[k]);
  }
}

TEST(SampleDesign, MonteCarloIsUniformDraws) {
  const SampleDesign design({.dimensions = 6, .points = 10, .seed = 4});
  std::vector<double> u, drawn(6);
  design.point(7, u);
  uniform_draws(4, static_cast<std::uint64_t>(UniformFor::kPoint), 7, drawn);
  EXPECT_EQ(u, drawn);
}

TEST(Permutation, IsOne) {
  for (const std::uint64_t n : {1u, 2u, 3u, 7u, 64u, 1000u, 12345u}) {
    const Permutation permutation(n, 5, 0);
    std::vector<std::uint64_t> values(n), all(n);
    for (std::uint64_t k = 0; k < n; ++k) values[k] = permutation(k);
    std::sort(values.begin(), values.end());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(values, all) << n;
  }
}

// Over 6,000 seeds each of the 24 permutations of four numbers comes 250 times on average, with a
// deviation of 15.5: chi-squared of 23 degrees of freedom is below 59 but once in 50,000.
TEST(Permutation, OfFourNumbersAreAllAsFrequent) {
  std::map<std::array<std::uint64_t, 4>, int> times;
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    const Permutation p(4, seed, 3);
    ++times[{p(0), p(1), p(2), p(3)}];
  }
  EXPECT_EQ(times.size(), 24u);
  double chi_squared = 0;
  for (const auto& [order, count] : times) chi_squared += (count - 250.) * (count - 250.) / 250;
  EXPECT_LT(chi_squared, 59);
}

TEST(SampleDesign, LatinHypercubeHasEachStratumOnceInEveryCoordinate) {
  for (const std::uint64_t n : {1u, 7u, 64u, 1000u}) {
    const SampleDesign design(
        {.kind = DesignKind::kLatinHypercube, .dimensions = 6, .points = n, .seed = 2});
    const Points points = all_points(design);
    for (std::size_t j = 0; j < 6; ++j) {
      std::set<long> strata;
      for (const std::vector<double>& u : points)
        strata.insert(static_cast<long>(u[j] * static_cast<double>(n)));
      EXPECT_EQ(strata.size(), n);
      EXPECT_EQ(*strata.rbegin(), static_cast<long>(n) - 1);
    }
  }
}

// Coordinates are permuted independently: a correlation has a deviation of 1/sqrt(n - 1).
TEST(SampleDesign, LatinHypercubeHasUncorrelatedCoordinates) {
  const std::uint64_t n = 5000;
  const Points points =
      all_points(SampleDesign({.kind = DesignKind::kLatinHypercube, .dimensions = 5, .points = n}));
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double product = 0;
      for (const std::vector<double>& u : points) product += 12 * (u[i] - 0.5) * (u[j] - 0.5);
      EXPECT_NEAR(product / static_cast<double>(n), 0, 4.5 / std::sqrt(static_cast<double>(n)));
    }
}

// Without its shift it is the library's sequence, with the origin that the engine leaves out before it.
TEST(SobolPoints, AreTheLibrarysShifted) {
  const std::size_t d = 40;
  const SobolPoints points(d, 17);
  std::vector<std::uint64_t> shift(d);
  for (std::size_t j = 0; j < d; ++j)
    shift[j] = random_bits({0, j, 1, 0}, {17, static_cast<std::uint64_t>(UniformFor::kShift)})[0];
  boost::random::sobol engine(d);
  for (std::size_t j = 0; j < d; ++j) EXPECT_EQ(points.coordinate(0, j), open_unit(shift[j]));
  for (std::uint64_t k = 1; k < 300; ++k)
    for (std::size_t j = 0; j < d; ++j)
      EXPECT_EQ(points.coordinate(k, j), open_unit(engine() ^ shift[j]));
  engine.seed(123456789012345);
  for (std::size_t j = 0; j < d; ++j)
    EXPECT_EQ(points.coordinate(123456789012346, j), open_unit(engine() ^ shift[j]));
}

// The first 2^m points: one in each interval of length 2^-m of every coordinate; of the first two
// coordinates, a (0, m, 2)-net, one in each of the 2^a by 2^(m - a) boxes.
TEST(SobolPoints, HaveOnePointInEachElementaryInterval) {
  const int m = 8;
  const SobolPoints points(12, 3);
  for (std::size_t j = 0; j < 12; ++j) {
    std::set<int> intervals;
    for (std::uint64_t k = 0; k < 1u << m; ++k)
      intervals.insert(static_cast<int>(std::ldexp(points.coordinate(k, j), m)));
    EXPECT_EQ(intervals.size(), 1u << m);
  }
  for (int a = 0; a <= m; ++a) {
    std::set<std::pair<int, int>> boxes;
    for (std::uint64_t k = 0; k < 1u << m; ++k)
      boxes.insert({static_cast<int>(std::ldexp(points.coordinate(k, 0), a)),
                    static_cast<int>(std::ldexp(points.coordinate(k, 1), m - a))});
    EXPECT_EQ(boxes.size(), 1u << m);
  }
}

/// Root mean square over seeds of the error of the mean of Π (1 + (u_j - 1/2)/2), whose integral is 1.
double integration_error(DesignKind kind, std::uint64_t n) {
  double squares = 0;
  const int seeds = 12;
  for (int seed = 0; seed < seeds; ++seed) {
    double sum = 0;
    for (const std::vector<double>& u : all_points(SampleDesign(
             {.kind = kind, .dimensions = 5, .points = n, .seed = static_cast<unsigned>(seed)}))) {
      double product = 1;
      for (const double c : u) product *= 1 + (c - 0.5) / 2;
      sum += product;
    }
    squares += std::pow(sum / static_cast<double>(n) - 1, 2);
  }
  return std::sqrt(squares / seeds);
}

// 64 times the points: Sobol's error falls about 64-fold (n^-1, but for logarithms), that of independent
// points 8-fold (n^-1/2).
TEST(SampleDesign, SobolIntegratesWithNearlyFirstOrder) {
  const double sobol =
      integration_error(DesignKind::kSobol, 128) / integration_error(DesignKind::kSobol, 8192);
  EXPECT_GT(std::log(sobol) / std::log(64.), 0.85);
  const double independent = integration_error(DesignKind::kMonteCarlo, 128) /
                             integration_error(DesignKind::kMonteCarlo, 8192);
  EXPECT_NEAR(std::log(independent) / std::log(64.), 0.5, 0.2);
}

TEST(SampleDesign, SaltelliHasBlocksThatDifferInOneCoordinate) {
  const std::size_t d = 4;
  const SampleDesign design(
      {.kind = DesignKind::kSaltelli, .dimensions = d, .points = 50, .seed = 6});
  const SobolPoints sobol(2 * d, 6);
  ASSERT_EQ(design.size(), 50 * (d + 2));
  const Points points = all_points(design);
  for (std::size_t row = 0; row < 50; ++row) {
    const std::vector<double>&a = points[row * (d + 2)], &b = points[row * (d + 2) + 1];
    for (std::size_t j = 0; j < d; ++j) {
      EXPECT_EQ(a[j], sobol.coordinate(row, j));
      EXPECT_EQ(b[j], sobol.coordinate(row, d + j));
      std::vector<double> mixed = a;
      mixed[j] = b[j];
      EXPECT_EQ(points[row * (d + 2) + 2 + j], mixed);
    }
  }
}

TEST(SampleDesign, GridHasAllCombinationsOfMidpoints) {
  const SampleDesign design({.kind = DesignKind::kGrid, .dimensions = 3, .levels = 4});
  const Points points = all_points(design);
  ASSERT_EQ(points.size(), 64u);
  EXPECT_EQ(points[0], (std::vector<double>{0.125, 0.125, 0.125}));
  EXPECT_EQ(points[1], (std::vector<double>{0.125, 0.125, 0.375}));
  EXPECT_EQ(points[63], (std::vector<double>{0.875, 0.875, 0.875}));
  EXPECT_EQ(std::set(points.begin(), points.end()).size(), 64u);
  for (const std::vector<double>& u : points)
    for (const double c : u) EXPECT_EQ(4 * c, std::floor(4 * c) + 0.5);
  EXPECT_EQ(SampleDesign({.kind = DesignKind::kGrid, .dimensions = 80, .levels = 1}).size(), 1u);
}

TEST(SampleDesign, RefusesWhatCannotBe) {
  EXPECT_EQ(error_of({.dimensions = 0, .points = 5}),
            "the design has no dimension: nothing varies");
  EXPECT_EQ(error_of({.points = 0}), "the design has no points");
  EXPECT_EQ(error_of({.points = (std::uint64_t{1} << 53) + 1}),
            "the design has more than 2^53 points");
  EXPECT_EQ(error_of({.kind = DesignKind::kGrid, .dimensions = 34, .levels = 3}),
            "the design has more than 2^53 points");
  EXPECT_EQ(error_of({.kind = DesignKind::kGrid, .levels = 0}),
            "a grid has 0 levels, expected at least 1");
  EXPECT_EQ(error_of({.kind = DesignKind::kSaltelli, .dimensions = 1834, .points = 8}),
            "1834 numbers vary, of which Sobol's sequence takes 3668 dimensions; it has 3667");
  EXPECT_EQ(error_of({.kind = DesignKind::kSobol, .dimensions = 3667, .points = 8}), "");
}

}  // namespace
}  // namespace condyle
