#include "condyle/study/summarise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "condyle/design/uniform_draws.h"
#include "condyle/study/quantiles.h"
#include "condyle/study/sobol_indices.h"
#include "study/missing.h"
#include "study/saltelli_values.h"

namespace condyle {
namespace {

// By hand: of 1, 2, 4, 8 the places of the levels are 3q; numpy.quantile gives the same.
TEST(Quantiles, StandBetweenValuesLinearly) {
  std::vector<double> sample = {8, 1, 4, 2};
  const std::array levels = {0., 0.05, 0.25, 0.5, 0.75, 0.95, 1.};
  const std::array expected = {1., 1.15, 1.75, 3., 5., 7.4, 8.};
  const std::vector<double> quantiles = take_quantiles(sample, levels);
  for (std::size_t i = 0; i < levels.size(); ++i) EXPECT_NEAR(quantiles[i], expected[i], 1e-14);
  std::vector<double> one = {3}, none;
  EXPECT_EQ(take_quantiles(one, levels), std::vector<double>(7, 3.));
  EXPECT_TRUE(std::isnan(take_quantiles(none, levels)[3]));
}

// Three poses of five samples: complete, with one missing, and one alone.
TEST(StudyBand, IsToldOfThePosesThatAreThere) {
  const std::vector<double> values = {1, 5, kMissing, 2,        kMissing, kMissing, 3,       1,
                                      7, 4, 3,        kMissing, 5,        2,        kMissing};
  const StudyBand band = study_band({values, 3}, {9, 8, kMissing});
  EXPECT_EQ(band.samples, (std::vector<long>{5, 4, 1}));
  EXPECT_EQ(band.mean[0], 3);
  EXPECT_NEAR(band.sd[0], std::sqrt(2.5), 1e-15);
  EXPECT_NEAR(band.mean[1], 2.75, 1e-15);
  EXPECT_EQ(band.mean[2], 7);
  EXPECT_TRUE(std::isnan(band.sd[2]));
  EXPECT_NEAR(band.quantiles[0][0], 1.2, 1e-15);
  EXPECT_EQ(band.quantiles[2][0], 3);
  EXPECT_NEAR(band.quantiles[4][1], 4.7, 1e-14);
  EXPECT_EQ(band.quantiles[1][2], 7);
  EXPECT_EQ(band.nominal[1], 8);
}

TEST(StudyBand, OfNoPoseIsNoNumber) {
  const std::vector<double> values = {kMissing, kMissing};
  const StudyBand band = study_band({values, 1}, {0});
  EXPECT_EQ(band.samples[0], 0);
  EXPECT_TRUE(std::isnan(band.mean[0]));
  EXPECT_TRUE(std::isnan(band.quantiles[2][0]));
}

std::vector<std::vector<double>> drawn(std::size_t parameters, std::size_t samples) {
  std::vector<std::vector<double>> theta(parameters, std::vector<double>(samples));
  std::vector<double> u(parameters);
  for (std::size_t k = 0; k < samples; ++k) {
    uniform_draws(1, 99, k, u);
    for (std::size_t j = 0; j < parameters; ++j) theta[j][k] = u[j];
  }
  return theta;
}

// A prescribed flexion is an output like any other: 45 degrees, but for rounding.
TEST(StudyEffects, OfWhatDoesNotVaryThereIsNoRankCorrelation) {
  const std::vector<std::vector<double>> theta = drawn(2, 50);
  std::vector<double> still, zero, moving;
  for (std::size_t k = 0; k < 50; ++k) {
    still.push_back(45 + 1e-13 * theta[0][k]);
    zero.push_back(0);
    moving.push_back(45 + 1e-6 * theta[0][k]);
  }
  const RankedParameters parameters = ranked_parameters(theta, false);
  EXPECT_TRUE(std::isnan(study_effects({still, 1}, parameters).rank[0][0]));
  EXPECT_TRUE(std::isnan(study_effects({zero, 1}, parameters).rank[1][0]));
  EXPECT_NEAR(study_effects({moving, 1}, parameters).rank[0][0], 1, 1e-12);
}

TEST(RankCorrelation, OfWhatRisesOrFallsIsOneExactly) {
  const std::vector<std::vector<double>> theta = drawn(2, 101);
  std::vector<double> y;
  for (const double x : theta[0]) {
    y.push_back(std::exp(5 * x));
    y.push_back(-x * x * x);
  }
  const StudyEffects effects = study_effects({y, 2}, theta, false);
  EXPECT_NEAR(effects.rank[0][0], 1, 1e-15);
  EXPECT_NEAR(effects.rank[0][1], -1, 1e-15);
  EXPECT_NEAR(effects.rank[1][0], 0, 0.4);  // four deviations of 1/sqrt(100)
  EXPECT_TRUE(effects.first.empty());
}

// x = 1 2 2 3, y = 5 7 6 6: ranks 1 2.5 2.5 4 and 1 4 2.5 2.5, about the mean -1.5 0 0 1.5 and
// -1.5 1.5 0 0: 2.25/4.5. The fifth sample has no pose.
TEST(RankCorrelation, GivesTiesTheirAverage) {
  const std::vector<double> y = {5, 7, kMissing, 6, 6};
  const StudyEffects effects = study_effects({y, 1}, {{1, 2, 1.5, 2, 3}}, false);
  EXPECT_NEAR(effects.rank[0][0], 0.5, 1e-15);
}

TEST(RankCorrelation, OfWhatDoesNotVaryIsNone) {
  const std::vector<double> same = {1, 1, 1, 1}, y = {1, 2, 3, 4};
  EXPECT_TRUE(std::isnan(study_effects({same, 1}, {{1, 2, 3, 4}}, false).rank[0][0]));
  EXPECT_TRUE(std::isnan(study_effects({y, 1}, {{1, 1, 1, 1}}, false).rank[0][0]));
  const std::vector<double> two = {1, kMissing, kMissing, 4};
  EXPECT_TRUE(std::isnan(study_effects({two, 1}, {{1, 2, 3, 4}}, false).rank[0][0]));
}

// Missing samples change ranks as if they had never been.
TEST(RankCorrelation, OfSamplesWithHolesIsThatOfTheRest) {
  const std::vector<std::vector<double>> theta = drawn(2, 300);
  std::vector<double> y, some;
  std::vector<std::vector<double>> of_some(2);
  for (std::size_t k = 0; k < 300; ++k) {
    const double value = theta[0][k] + theta[1][k] * theta[1][k];
    y.push_back(theta[0][k] > 0.8 ? kMissing : value);
    if (theta[0][k] > 0.8) continue;
    some.push_back(value);
    for (std::size_t j = 0; j < 2; ++j) of_some[j].push_back(theta[j][k]);
  }
  const StudyEffects a = study_effects({y, 1}, theta, false);
  const StudyEffects b = study_effects({some, 1}, of_some, false);
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(a.rank[j][0], b.rank[j][0], 1e-14);
}

// Indices of each pose by itself; ranks of blocks A and B alone, whose points are independent.
TEST(StudyEffects, OfADesignOfSaltelli) {
  const std::size_t n = 128;
  const SampleDesign design({.kind = DesignKind::kSaltelli, .dimensions = 3, .points = n});
  std::vector<std::vector<double>> theta(3), of_ab(3);
  std::vector<double> y, u, first_pose, linear_of_ab;
  for (std::uint64_t k = 0; k < design.size(); ++k) {
    design.point(k, u);
    const double linear = u[0] + 0.3 * u[2];
    y.insert(y.end(), {ishigami(u), linear});
    first_pose.push_back(ishigami(u));
    for (std::size_t j = 0; j < 3; ++j) theta[j].push_back(u[j]);
    if (k % 5 >= 2) continue;
    linear_of_ab.push_back(linear);
    for (std::size_t j = 0; j < 3; ++j) of_ab[j].push_back(u[j]);
  }
  const StudyEffects effects = study_effects({y, 2}, theta, true);
  const SobolIndices expected = sobol_indices(first_pose.data(), n, 3, 1);
  const StudyEffects ranks = study_effects({linear_of_ab, 1}, of_ab, false);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(effects.first[j][0].value, expected.first[j].value);
    EXPECT_EQ(effects.total[j][0].upper, expected.total[j].upper);
    EXPECT_EQ(effects.rank[j][1], ranks.rank[j][0]);
  }
  EXPECT_EQ(effects.total[1][1].value, 0);
}

TEST(StudyEffects, DoNotDependOnThreads) {
  const std::vector<std::vector<double>> theta = drawn(3, 6000);
  std::vector<double> y(6000 * 9), u(1);
  for (std::size_t i = 0; i < y.size(); ++i) {
    uniform_draws(2, 99, i, u);
    y[i] = u[0] < 0.05 ? kMissing : u[0] + theta[0][i / 9];
  }
  const RankedParameters ranked = ranked_parameters(theta, false);
  EXPECT_EQ(study_effects({y, 9}, ranked, 1).rank, study_effects({y, 9}, ranked, 4).rank);
  const std::vector<double> nominal(9);
  const StudyBand one = study_band({y, 9}, nominal, 1), four = study_band({y, 9}, nominal, 4);
  EXPECT_EQ(one.mean, four.mean);
  EXPECT_EQ(one.quantiles, four.quantiles);
}

// The last number of a grid of four levels: every fourth sample has the same.
TEST(RankedParameters, OfVeryManySamplesAreDrawnWhateverTheirOrder) {
  std::vector<double> theta(4 * kMostRanked);
  for (std::size_t k = 0; k < theta.size(); ++k) theta[k] = static_cast<double>(k % 4);
  const RankedParameters ranked = ranked_parameters({theta}, false);
  ASSERT_EQ(ranked.samples.size(), kMostRanked);
  std::array<double, 4> share{};
  for (const std::uint32_t sample : ranked.samples) share[sample % 4] += 1. / kMostRanked;
  for (std::size_t i = 1; i < kMostRanked; ++i)
    ASSERT_LT(ranked.samples[i - 1], ranked.samples[i]) << "once each, in order";
  for (const double each : share) EXPECT_NEAR(each, 0.25, 0.01);  // deviation 0.0015
  const std::vector<double>& y = theta;
  EXPECT_NEAR(study_effects({y, 1}, ranked).rank[0][0], 1, 1e-12);
}

// Eight samples of two poses, a parameter that counts them and one that is the same throughout: samples
// 5 (both poses), 6 and 7 fail.
TEST(StudyFailures, AreCountedByPoseStatusAndQuarter) {
  std::vector<std::uint8_t> status(16, 0);
  status[2 * 5] = 4;
  status[2 * 5 + 1] = 8;
  status[2 * 6 + 1] = 4;
  status[2 * 7 + 1] = 4;
  const StudyFailures failures =
      study_failures(status, 2, {{0, 1, 2, 3, 4, 5, 6, 7}, std::vector<double>(8, 3.)}, false);
  EXPECT_EQ(failures.poses, 16);
  EXPECT_EQ(failures.failed, 4);
  EXPECT_EQ(failures.incomplete, 3);
  EXPECT_EQ(failures.by_pose, (std::vector<long>{1, 3}));
  EXPECT_EQ(failures.by_status[0][0], 7);
  EXPECT_EQ(failures.by_status[0][4], 1);
  EXPECT_EQ(failures.by_status[1][4], 2);
  EXPECT_EQ(failures.by_status[1][8], 1);
  EXPECT_EQ(failures.by_quartile[0], (std::array{0., 0., 0.5, 0.5}));
  EXPECT_EQ(failures.by_quartile[1][0], 0.25);
  EXPECT_TRUE(std::isnan(failures.by_quartile[1][1]));
}

// Of a design of Saltelli a number has each of its values in all but one of the samples of a base point: that all of
// one point fail says nothing of it.
TEST(StudyFailures, QuartersOfADesignOfSaltelliAreThoseOfItsOwnSamples) {
  std::vector<double> theta;
  std::vector<std::uint8_t> status;
  for (int point = 0; point < 4; ++point)
    for (int block = 0; block < 3; ++block) {
      theta.push_back(block == 1 ? 4 + point : point);  // A, B, A with the B of this number
      status.push_back(point == 1 ? 4 : 0);
    }
  theta[2] = theta[1], theta[5] = theta[4], theta[8] = theta[7], theta[11] = theta[10];
  const StudyFailures failures = study_failures(status, 1, {theta}, true);
  EXPECT_EQ(failures.failed, 3);
  EXPECT_EQ(failures.by_quartile[0], (std::array{0.5, 0., 0.5, 0.}));
}

}  // namespace
}  // namespace condyle
