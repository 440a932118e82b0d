#include "condyle/design/random_bits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "condyle/design/normal_draws.h"
#include "condyle/design/uniform_draws.h"

namespace condyle {
namespace {

using Four = std::array<std::uint64_t, 4>;

// The three known answers of Random123's kat_vectors: philox4x64, ten rounds.
TEST(RandomBits, GiveTheKnownAnswers) {
  EXPECT_EQ(random_bits({0, 0, 0, 0}, {0, 0}),
            (Four{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
  const std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(random_bits({all, all, all, all}, {all, all}),
            (Four{0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}));
  EXPECT_EQ(
      random_bits({0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
                  {0x452821e638d01377, 0xbe5466cf34e90c6c}),
      (Four{0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6}));
}

TEST(RandomBits, BecomeNumbersOfTheOpenUnitInterval) {
  EXPECT_EQ(open_unit(0), 0x1p-53);
  EXPECT_EQ(open_unit(std::numeric_limits<std::uint64_t>::max()), 1 - 0x1p-53);
  EXPECT_EQ(open_unit(std::uint64_t{1} << 63), 0.5 + 0x1p-53);
}

TEST(UniformDraws, AreAFunctionOfWhereTheyStand) {
  std::vector<double> five(5), nine(9), other(5);
  uniform_draws(7, 1, 3, five);
  uniform_draws(7, 1, 3, nine);
  EXPECT_TRUE(std::equal(five.begin(), five.end(), nine.begin()));
  EXPECT_EQ(five[0], open_unit(random_bits({0, 3, 1, 0}, {7, 1})[0]));
  EXPECT_EQ(five[4], open_unit(random_bits({1, 3, 1, 0}, {7, 1})[0]));
  const std::array<std::array<std::uint64_t, 3>, 3> elsewhere = {{{8, 1, 3}, {7, 2, 3}, {7, 1, 4}}};
  for (const auto& [seed, what, sample] : elsewhere) {
    uniform_draws(seed, what, sample, other);
    for (std::size_t i = 0; i < five.size(); ++i) EXPECT_NE(five[i], other[i]);
  }
}

// Of n = 40,000 numbers: the mean has a deviation of 1/sqrt(12 n), the variance of 1/sqrt(180 n), a
// correlation of 1/sqrt(n); bounds are five of these.
TEST(UniformDraws, HaveMeanVarianceAndIndependence) {
  const int n = 40000;
  std::vector<double> u(6);
  std::array<double, 6> sum{}, squares{};
  std::array<double, 6> next{};  // products of neighbours
  for (int k = 0; k < n; ++k) {
    uniform_draws(11, 5, static_cast<std::uint64_t>(k), u);
    for (std::size_t i = 0; i < 6; ++i) {
      const double c = u[i] - 0.5;
      sum[i] += c;
      squares[i] += c * c;
      next[i] += c * (u[(i + 1) % 6] - 0.5);
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(sum[i] / n, 0, 5 / std::sqrt(12. * n));
    EXPECT_NEAR(squares[i] / n, 1. / 12, 5 / std::sqrt(180. * n));
    EXPECT_NEAR(12 * next[i] / n, 0, 5 / std::sqrt(1. * n));
  }
}

// The same seed, use and sample as normal_draws: no bits are shared.
TEST(UniformDraws, AreIndependentOfNormalDraws) {
  const int n = 20000;
  double with_first = 0, with_square = 0;
  std::vector<double> u(1);
  for (int k = 0; k < n; ++k) {
    const auto sample = static_cast<std::uint64_t>(k);
    uniform_draws(3, static_cast<std::uint64_t>(DrawsFor::kStart), sample, u);
    const double z = normal_draws(3, DrawsFor::kStart, sample, 1)[0];
    with_first += std::sqrt(12.) * (u[0] - 0.5) * z;
    with_square += std::sqrt(12.) * (u[0] - 0.5) * (z * z - 1) / std::sqrt(2.);
  }
  EXPECT_NEAR(with_first / n, 0, 5 / std::sqrt(1. * n));
  EXPECT_NEAR(with_square / n, 0, 5 / std::sqrt(1. * n));
}

}  // namespace
}  // namespace condyle
