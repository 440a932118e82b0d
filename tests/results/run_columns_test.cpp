#include "condyle/results/run_columns.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>

#include "condyle/results/run_view.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

/// NaN is the same as NaN.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

bool same_values(const DataColumn& a, const DataColumn& b) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&a.values)) {
    const auto* others = std::get_if<std::vector<double>>(&b.values);
    return others != nullptr && same_bits(*numbers, *others);
  }
  return a.values == b.values;
}

/// How many columns there are.
int expect_same_columns(const ColumnTree& a, const ColumnTree& b, const std::string& place) {
  int count = 0;
  EXPECT_EQ(a.names, b.names) << place;
  for (const auto& [name, column] : a.columns) {
    const DataColumn* other = b.column(name);
    if (other == nullptr) continue;
    EXPECT_TRUE(same_values(column, *other)) << place << name;
    EXPECT_EQ(column.shape, other->shape) << place << name;
    EXPECT_EQ(column.units, other->units) << place << name;
    EXPECT_EQ(column.attributes, other->attributes) << place << name;
    ++count;
  }
  for (const auto& [name, group] : a.groups)
    if (const ColumnTree* other = b.group(name))
      count += expect_same_columns(*group, *other, place + name + "/");
  return count;
}

TEST(RunColumns, AreThoseOfTheFileInItsOrder) {
  const condyle::Run run = made_up_run();
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("columns_" + std::to_string(::getpid()) + ".h5");
  write_run(path, run);
  const RunWithColumns read = read_run_with_columns(path);
  std::filesystem::remove(path);
  EXPECT_GT(expect_same_columns(columns_of(run), read.columns, "/"), 50);
}

TEST(RunColumns, OfASweepAreTheSameByItsParts) {
  const condyle::Run run = made_up_run();
  const ColumnTree whole = columns_of(run);
  ColumnTree sweep;
  for (int part = 0; part < kSweepPartCount; ++part)
    add_columns(sweep, static_cast<SweepPart>(part), run.scene, swept_quantity(run).unit,
                run.sweep.poses);
  add_columns_beside_poses(sweep, run);
  EXPECT_GT(expect_same_columns(*whole.group("sweep"), sweep, "/sweep/"), 40);
  EXPECT_EQ(columns_beside_sweep(run).group("sweep"), nullptr);
  for (const std::string& member : whole.group("sweep")->names) {
    if (member == "sensitivities" || member == "uncertainty") continue;
    ColumnTree alone;
    add_columns(alone, part_with(member), run.scene, swept_quantity(run).unit, run.sweep.poses);
    EXPECT_TRUE(alone.group(member) != nullptr || alone.column(member) != nullptr) << member;
  }
}

}  // namespace
}  // namespace condyle
