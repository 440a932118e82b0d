#include "condyle/results/sweep_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/results/run_view.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

TEST(SweepTable, HasAColumnForEverythingInItsUnit) {
  const condyle::Run run = made_up_run();
  // The swept flexion, the five other coordinates, one contact, one ligament; numbers of
  // made_up_pose(2).
  EXPECT_EQ(SweepTable(run.scene, swept_quantity(run)).head(),
            "    bend  adduct int.rot  lat.sh  ant.dr   distr  medial    aACL  iter  time\n"
            "     deg     deg     deg      mm      mm      mm       N       N          us\n");
  EXPECT_EQ(SweepTable(run.scene, swept_quantity(run)).row(run.sweep.poses[2]),
            "   11.46   11.46   17.19    4.00    5.00    6.00    70.0    14.0     3     5\n");
}

TEST(SweepTable, ValuesThatLieCloseAreToldApart) {
  const condyle::Run run = made_up_run();
  const auto first_of = [&](const std::vector<double>& values) {
    const std::string row =
        SweepTable(run.scene, swept_quantity(run), values).row(run.sweep.poses[2]);
    return row.substr(0, row.find(' ', row.find_first_not_of(' ')));
  };
  EXPECT_EQ(first_of({0, 0.1, 0.2}), "   11.46");
  EXPECT_EQ(first_of({0, 1e-4, 2e-4}), "   11.459");        // 0.0057 degrees
  EXPECT_EQ(first_of({0.2, 0.2 + 1e-12}), "   11.459156");  // no more than six
}

TEST(SweepTable, NumbersThatFillTheirColumnsStandApart) {
  condyle::Run run = made_up_run();
  run.sweep.poses[2].iterations = 90;
  run.sweep.poses[2].seconds = 0.208292;
  const std::string row = SweepTable(run.scene, swept_quantity(run)).row(run.sweep.poses[2]);
  EXPECT_NE(row.find(" 90 208292"), std::string::npos) << row;
}

TEST(SweepTable, SaysWhyAPoseFailed) {
  const condyle::Run run = made_up_run();
  EXPECT_EQ(SweepTable(run.scene, swept_quantity(run)).row(run.sweep.poses[1]),
            std::string("    5.73  ") + name(PoseStatus::kSingular) +
                ": nothing resists turning about x\n");
  ASSERT_EQ(failures(swept_quantity(run), run.sweep).size(), 1U);
  EXPECT_EQ(failures(swept_quantity(run), run.sweep)[0], std::string("bend = 5.72958 deg: ") +
                                                             name(PoseStatus::kSingular) +
                                                             ": nothing resists turning about x");
}

TEST(EventLines, NameTheContactWhereOneIsMeant) {
  condyle::Run run = made_up_run();
  run.sweep.events = {{0.5 * M_PI, EventKind::kOpening, 0}, {M_PI, EventKind::kLimitPoint, -1}};
  EXPECT_EQ(event_lines(run.scene, swept_quantity(run), run.sweep),
            (std::vector<std::string>{"medial: opening at 90.000000 deg",
                                      "limit point at 180.000000 deg"}));
}

TEST(EventLines, AFactorHasNoUnit) {
  condyle::Run run = made_up_run();
  run.sweep.events = {{0.5, EventKind::kOpening, 0}};
  SweptQuantity factor = swept_quantity(run);
  factor.unit = Unit{"1", 1};
  EXPECT_EQ(event_lines(run.scene, factor, run.sweep)[0], "medial: opening at 0.500000");
}

TEST(Summary, CountsAndNamesTheLargest) {
  const condyle::Run run = made_up_run();
  // Gap 4e-11 mm is that of the second point of the last pose, seed 4; two poses of 5 us.
  EXPECT_EQ(summary(run.sweep),
            "2 of 3 poses converged, largest residual 1e-12 N, largest gap 4e-11 mm, 10 us (3.33 "
            "us a pose)");
}

}  // namespace
}  // namespace condyle
