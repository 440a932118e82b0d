#include "results/sweep_table.h"

#include <gtest/gtest.h>

#include "results/made_up_run.h"

namespace condyle {
namespace {

std::vector<std::string> column_names(const std::vector<std::string>& names, std::size_t most) {
  std::vector<std::string> out;
  for (const LigamentColumn& column : ligament_columns(names, most)) out.push_back(column.name);
  return out;
}

TEST(LigamentColumns, AreTheLigamentsWhereThereAreFew) {
  EXPECT_EQ(column_names({"aACL", "pACL2"}, 2), (std::vector<std::string>{"aACL", "pACL2"}));
}

TEST(LigamentColumns, LeaveOutTheNumberWhereThereAreMany) {
  EXPECT_EQ(column_names({"ACLam1", "ACLam2", "ACLpl1", "LCL1"}, 3),
            (std::vector<std::string>{"ACLam", "ACLpl", "LCL"}));
}

TEST(LigamentColumns, LeaveOutThePartWhereThereAreStillMany) {
  EXPECT_EQ(column_names({"ACLam1", "ACLam2", "ACLpl1", "pCAP1"}, 2),
            (std::vector<std::string>{"ACL", "pCAP"}));
}

TEST(LigamentColumns, HoldEveryLigamentOnce) {
  const std::vector<LigamentColumn> columns = ligament_columns({"a1", "b", "a2"}, 2);
  ASSERT_EQ(columns.size(), 2U);
  EXPECT_EQ(columns[0].members, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(columns[1].members, (std::vector<std::size_t>{1}));
}

TEST(SweepTable, HasAColumnForEverythingInItsUnit) {
  const condyle::Run run = made_up_run();
  // The swept flexion, the five other coordinates, one contact, one ligament; numbers of
  // made_up_pose(2).
  EXPECT_EQ(SweepTable(run.scene).head(),
            "    bend  adduct int.rot  lat.sh  ant.dr   distr  medial    aACL  iter  time\n"
            "     deg     deg     deg      mm      mm      mm       N       N          us\n");
  EXPECT_EQ(SweepTable(run.scene).row(run.sweep.poses[2]),
            "   11.46   11.46   17.19    4.00    5.00    6.00    70.0    14.0     3     5\n");
}

TEST(SweepTable, SaysWhyAPoseFailed) {
  const condyle::Run run = made_up_run();
  EXPECT_EQ(SweepTable(run.scene).row(run.sweep.poses[1]),
            std::string("    5.73  ") + name(PoseStatus::kSingular) +
                ": nothing resists turning about x\n");
  ASSERT_EQ(failures(run.scene, run.sweep).size(), 1U);
  EXPECT_EQ(failures(run.scene, run.sweep)[0], std::string("bend = 5.72958 deg: ") +
                                                   name(PoseStatus::kSingular) +
                                                   ": nothing resists turning about x");
}

TEST(Summary, CountsAndNamesTheLargest) {
  const condyle::Run run = made_up_run();
  // Gap 4e-11 mm is that of the second point of the last pose, seed 4; two poses of 5 us.
  EXPECT_EQ(summary(run.sweep),
            "2 of 3 poses converged, largest residual 1e-12 N, largest gap 4e-11 mm, 0.01 ms (3.33 "
            "us a pose)");
}

}  // namespace
}  // namespace condyle
