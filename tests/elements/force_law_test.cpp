#include "condyle/elements/force_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "condyle/elements/law_rates.h"
#include "condyle/input_error.h"
#include "support/allocation_count.h"

namespace condyle {
namespace {

/// df/dL against the slope and dE/dL against the force, by differences of fourth order.
void expect_consistent(const ForceLaw& law, const std::vector<double>& lengths) {
  const double h = 1e-4;
  for (const double L : lengths) {
    const auto derivative = [&](auto member) {
      return (8 * (tension(law, L + h).*member - tension(law, L - h).*member) -
              (tension(law, L + 2 * h).*member - tension(law, L - 2 * h).*member)) /
             (12 * h);
    };
    const Tension t = tension(law, L);
    EXPECT_NEAR(derivative(&Tension::force), t.slope, 1e-7 * (1 + std::abs(t.slope)))
        << "L = " << L;
    EXPECT_NEAR(derivative(&Tension::energy), t.force, 1e-7 * (1 + std::abs(t.force)))
        << "L = " << L;
  }
}

TEST(ForceLaw, ToeLinearHasTheValuesOfItsFormula) {
  const ForceLaw law =
      ToeLinearLaw{.stiffness = 2000, .transition_strain = 0.06, .slack_length = 30};
  EXPECT_EQ(tension(law, 29.9).force, 0);
  EXPECT_EQ(tension(law, 30).slope, 0);
  // ε = 0.03: 2000 0.03²/(2 0.06) = 15 N;  ε = 0.06: 60 N from both sides;  ε = 0.1: 2000 (0.1 -
  // 0.03) = 140 N
  EXPECT_NEAR(tension(law, 30.9).force, 15, 1e-11);
  EXPECT_NEAR(tension(law, 31.8).force, 60, 1e-11);
  EXPECT_NEAR(tension(law, 33.0).force, 140, 1e-11);
  EXPECT_NEAR(tension(law, 33.0).slope, 2000. / 30, 1e-11);
  // ∫: toe 30 2000 0.06²/6 = 36, then 30 (60 + 140)/2 0.04 = 120 N mm
  EXPECT_NEAR(tension(law, 33.0).energy, 36 + 120, 1e-10);
}

// By differences of fourth order; in the toe, beyond it, slack, and beside the two lengths where the
// formula changes, where the rates are continuous.
TEST(ForceLaw, RatesByItsOwnNumbers) {
  const double h = 1e-4;
  const auto rate = [h](const auto& law, auto member, double scale, double L) {
    const auto force = [&](double by) {
      auto changed = law;
      changed.*member += by * scale;
      return tension(ForceLaw(changed), L).force;
    };
    return (8 * (force(h) - force(-h)) - (force(2 * h) - force(-2 * h))) / (12 * h * scale);
  };
  const ToeLinearLaw toe{.stiffness = 2000, .transition_strain = 0.06, .slack_length = 30};
  for (const double L : {29.0, 30.4, 31.7, 31.9, 33.0}) {
    const LawRates rates = *law_rates(toe, L);
    EXPECT_NEAR(rates.slack_length, rate(toe, &ToeLinearLaw::slack_length, 1, L), 1e-6) << L;
    EXPECT_NEAR(rates.stiffness, rate(toe, &ToeLinearLaw::stiffness, 100, L), 1e-10) << L;
    EXPECT_NEAR(rates.transition_strain, rate(toe, &ToeLinearLaw::transition_strain, 0.1, L), 1e-5)
        << L;
  }
  const QuadraticLaw quadratic{.stiffness = 15, .slack_length = 40};
  for (const double L : {39.0, 40.5, 44.0}) {
    const LawRates rates = *law_rates(quadratic, L);
    EXPECT_NEAR(rates.slack_length, rate(quadratic, &QuadraticLaw::slack_length, 1, L), 1e-8) << L;
    EXPECT_NEAR(rates.stiffness, rate(quadratic, &QuadraticLaw::stiffness, 10, L), 1e-9) << L;
    EXPECT_EQ(rates.transition_strain, 0);
  }
  for (const double edge : {30.0, 31.8}) {
    const LawRates below = *law_rates(toe, edge - 1e-9), above = *law_rates(toe, edge + 1e-9);
    EXPECT_NEAR(below.slack_length, above.slack_length, 1e-5);
    EXPECT_NEAR(below.transition_strain, above.transition_strain, 1e-4);
  }
  EXPECT_FALSE(law_rates(PolynomialLaw{{1, 2}}, 30));
}

TEST(ForceLaw, QuadraticPullsOnlyBeyondItsSlackLength) {
  const ForceLaw law = QuadraticLaw{.stiffness = 15, .slack_length = 40};
  EXPECT_EQ(tension(law, 39).force, 0);
  EXPECT_NEAR(tension(law, 42).force, 15 * 4, 1e-12);
  EXPECT_NEAR(tension(law, 42).energy, 15 * 8 / 3., 1e-12);
}

TEST(ForceLaw, PolynomialMayPushUnlessCutOff) {
  // f = L² - 5L + 6 = (L - 2)(L - 3)
  const ForceLaw both = PolynomialLaw{{6, -5, 1}, false}, taut = PolynomialLaw{{6, -5, 1}, true};
  EXPECT_NEAR(tension(both, 2.5).force, -0.25, 1e-15);
  EXPECT_EQ(tension(taut, 2.5).force, 0);
  EXPECT_EQ(tension(taut, 2.5).slope, 0);
  EXPECT_NEAR(tension(taut, 5).force, 6, 1e-13);
  // ∫ from 0 to 2 is 8/3 - 10 + 12 = 14/3, slack to 3, from 3 to 5 is 98/3 - 40 + 12 = 14/3
  EXPECT_NEAR(tension(taut, 2.5).energy, 14. / 3, 1e-12);
  EXPECT_NEAR(tension(taut, 5).energy, 28. / 3, 1e-12);
}

TEST(ForceLaw, SlopeAndEnergyAreTheDerivativeAndTheIntegralOfTheForce) {
  expect_consistent(ToeLinearLaw{5000, 0.06, 30}, {25, 30.3, 31, 31.79, 31.81, 34});
  expect_consistent(QuadraticLaw{15, 40}, {38, 40.5, 44});
  expect_consistent(PolynomialLaw{{1, 1, 2}, false}, {0.5, 1, 5});
  expect_consistent(PolynomialLaw{{6, -5, 1}, true}, {1.5, 2.5, 3.5, 5});
  expect_consistent(make_table_law({10, 11, 13, 14, 18}, {0, 1, 4, 9, 10}),
                    {9, 10.5, 11.7, 13.2, 16, 17.99, 20});
}

TEST(ForceLaw, TablePassesThroughItsEntriesAndKeepsTheirMonotony) {
  const std::vector<double> lengths = {10, 11, 12, 13, 14, 15}, forces = {0, 0, 0, 5, 5.1, 40};
  const ForceLaw law = make_table_law(lengths, forces);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    EXPECT_NEAR(tension(law, lengths[i]).force, forces[i], 1e-13);
  for (double L = 9; L < 16; L += 0.01) EXPECT_GE(tension(law, L).slope, -1e-12) << L;
  for (double L = 9; L <= 12; L += 0.01) EXPECT_EQ(tension(law, L).force, 0) << L;
}

TEST(ForceLaw, TableOfAParabolaIsTheParabola) {
  // Slopes at inner and outer entries come from parabolas, so a monotone one is met exactly.
  const ForceLaw law = make_table_law({10, 11, 13, 14}, {100, 121, 169, 196});
  for (const double L : {10.5, 12.0, 13.7}) EXPECT_NEAR(tension(law, L).force, L * L, 1e-11);
}

TEST(ForceLaw, TableGoesOnWithConstantSlopeOutside) {
  const ForceLaw law = make_table_law({10, 12}, {4, 8});
  EXPECT_NEAR(tension(law, 9).force, 2, 1e-13);
  EXPECT_NEAR(tension(law, 15).force, 14, 1e-13);
  EXPECT_NEAR(tension(law, 15).energy, (4 + 14) / 2. * 5, 1e-12);
}

TEST(ForceLaw, TableSaysWhichEntryIsWrong) {
  const auto message = [](std::vector<double> lengths, std::vector<double> forces) -> std::string {
    try {
      (void)make_table_law(std::move(lengths), std::move(forces));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message({10, 12, 11}, {0, 1, 2}).find("lengths[2]"), std::string::npos);
  EXPECT_NE(message({10, 10}, {0, 1}).find("lengths[1]"), std::string::npos);
  EXPECT_NE(message({10}, {0}).find("at least 2"), std::string::npos);
  EXPECT_NE(message({}, {}).find("at least 2"), std::string::npos);
  EXPECT_NE(message({10, 11}, {0}).find("2 lengths and 1 forces"), std::string::npos);
  EXPECT_NE(message({10, 11}, {0, NAN}).find("forces[1]"), std::string::npos);
}

TEST(ForceLaw, CustomLawIsCalled) {
  const ForceLaw law = CustomLaw{[](double L) { return Tension{2 * L, 2, L * L}; }};
  EXPECT_EQ(tension(law, 7).force, 14);
}

TEST(ForceLaw, OnlyLawsWithASlackLengthHaveOne) {
  EXPECT_EQ(slack_length(ToeLinearLaw{1, 0.06, 30}), 30);
  EXPECT_EQ(slack_length(QuadraticLaw{1, 40}), 40);
  EXPECT_EQ(slack_length(PolynomialLaw{{1}, false}), 0);
}

TEST(ForceLaw, EvaluationAllocatesNothing) {
  const std::vector<ForceLaw> laws = {ToeLinearLaw{1, 0.06, 30}, QuadraticLaw{1, 4},
                                      PolynomialLaw{{-3, 1, 2}, true},
                                      make_table_law({1, 2, 3}, {1, 2, 4})};
  double sum = 0;
  const test::AllocationCount count;
  for (const ForceLaw& law : laws) sum += tension(law, 31).force;
  EXPECT_EQ(count.since_start(), 0);
  EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace condyle
