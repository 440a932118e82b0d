/// What differs in scenes, by names.

#include "condyle/report/scene_differences.h"

#include <gtest/gtest.h>

namespace condyle {
namespace {

std::string told(const std::vector<std::string>& texts) {
  std::string lines;
  for (const SceneDifference& difference : scene_differences(texts)) {
    lines += difference.where + "|" + difference.what;
    for (std::size_t s = 0; s < texts.size(); ++s) lines += "|" + value_beside_first(difference, s);
    lines += "\n";
  }
  return lines;
}

const std::string kScene =
    "title = \"A\"\n[units]\nlength = \"mm\"\n"
    "[[ligament]]\nname = \"ACL\"\nends = [ { body = \"femur\", at = [1, 2, 3] }, { body = "
    "\"tibia\", at "
    "= [4, 5, 6] } ]\nstiffness = 1000\n"
    "[[ligament]]\nname = \"PCL\"\nstiffness = 2000\n[sweep]\nto = 0\n";

std::string with_change(const std::string& from, const std::string& to) {
  std::string text = kScene;
  return text.replace(text.find(from), from.size(), to);
}

TEST(SceneDifferences, TellNumbersByTheNamesOfTheirTables) {
  EXPECT_EQ(told({kScene, with_change("1000", "1200.0")}),
            "ligament ACL|stiffness|1000|1200 (+20 %)\n");
  EXPECT_EQ(told({kScene, with_change("[4, 5, 6]", "[4, 5.5, 6]")}),
            "ligament ACL|ends[2].at|[4, 5, 6]|[4, 5.5, 6]\n");
  EXPECT_EQ(told({kScene, with_change("to = 0", "to = 90")}), "sweep|to|0|90\n")
      << "no percents of nothing";
  EXPECT_EQ(told({kScene, with_change("\"A\"", "\"B\"")}), "|title|\"A\"|\"B\"\n");
}

TEST(SceneDifferences, OfSeveralScenesStandBesideEachOther) {
  EXPECT_EQ(told({kScene, with_change("1000", "1100"), with_change("stiffness = 1000\n", "")}),
            "ligament ACL|stiffness|1000|1100|-\n");
}

TEST(SceneDifferences, OrderCommentsAndBlanksAreNone) {
  const std::string other =
      "# other words\n[sweep]\nto = 0.0\n[[ligament]]\nname = \"PCL\"\nstiffness = 2e3\n"
      "[[ligament]]\nstiffness   = 1000\nname = \"ACL\"\nends = [ { body = \"femur\", at = [1, 2, "
      "3] }, "
      "{ body = \"tibia\", at = [4, 5, 6] } ]\n[units]\nlength = \"mm\"\n";
  EXPECT_EQ(
      told({"title = \"A\"\n" + kScene.substr(kScene.find('\n') + 1), "title = \"A\"\n" + other}),
      "");
}

TEST(SceneDifferences, ATableThatOnlySomeHaveIsOneLine) {
  std::string less = kScene;
  const std::size_t begin = less.rfind("[[ligament]]");
  less.erase(begin, less.find("[sweep]") - begin);
  EXPECT_EQ(told({kScene, less}), "ligament PCL||there|-\n");
  EXPECT_EQ(told({less, kScene}), "ligament PCL||-|there\n");
}

// Shown shortened, they look the same.
TEST(SceneDifferences, LongListsAreComparedItemByItem) {
  std::string a = "values = [", b;
  for (int i = 0; i < 60; ++i) a += std::to_string(i) + ", ";
  b = a;
  EXPECT_EQ(told({a + "1]\n", b + "2]\n"}), "|values[61]|1|2 (+100 %)\n");
}

}  // namespace
}  // namespace condyle
