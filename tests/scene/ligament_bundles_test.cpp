#include "condyle/scene/ligament_bundles.h"

#include <gtest/gtest.h>

namespace condyle {
namespace {

std::vector<std::string> column_names(const std::vector<std::string>& names, std::size_t most) {
  std::vector<std::string> out;
  for (const LigamentBundle& column : ligament_columns(names, most)) out.push_back(column.name);
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
  const std::vector<LigamentBundle> columns = ligament_columns({"a1", "b", "a2"}, 2);
  ASSERT_EQ(columns.size(), 2U);
  EXPECT_EQ(columns[0].members, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(columns[1].members, (std::vector<std::size_t>{1}));
}

}  // namespace
}  // namespace condyle
