#pragma once

/// Two results, number by number, to the last bit: all but times and when they were made.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "condyle/results/run_columns.h"

namespace condyle::test {

inline bool same_bits(const DataColumn::Values& a, const DataColumn::Values& b) {
  return std::visit(
      [](const auto& x, const auto& y) {
        if constexpr (!std::is_same_v<decltype(x), decltype(y)>) {
          return false;
        } else if constexpr (std::is_same_v<decltype(x), const std::vector<double>&>) {
          return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](double p, double q) {
            return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q);
          });
        } else {
          return x == y;
        }
      },
      a, b);
}

inline void expect_same_columns(const ColumnTree& a,
                                const ColumnTree& b,
                                const std::string& place = "") {
  EXPECT_EQ(a.names, b.names) << place;
  for (const auto& [name, column] : a.columns) {
    if (name == "seconds" || name == "event_seconds") continue;
    const DataColumn* other = b.column(name);
    ASSERT_NE(other, nullptr) << place << '/' << name;
    EXPECT_EQ(column.shape, other->shape) << place << '/' << name;
    EXPECT_TRUE(same_bits(column.values, other->values)) << place << '/' << name;
  }
  for (const auto& [name, group] : a.groups) {
    const ColumnTree* other = b.group(name);
    ASSERT_NE(other, nullptr) << place << '/' << name;
    expect_same_columns(*group, *other, place + '/' + name);
  }
}

inline void expect_same_result(const std::filesystem::path& a, const std::filesystem::path& b) {
  expect_same_columns(read_run_with_columns(a).columns, read_run_with_columns(b).columns);
}

}  // namespace condyle::test
