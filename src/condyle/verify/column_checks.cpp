#include "condyle/verify/column_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "condyle/results/run_columns.h"

namespace condyle::verification {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Texts = std::vector<std::string>;

/// Integers as numbers; nothing for texts.
std::optional<std::vector<double>> numbers_of(const DataColumn& column) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) return *numbers;
  if (const auto* integers = std::get_if<std::vector<int>>(&column.values))
    return std::vector<double>(integers->begin(), integers->end());
  return std::nullopt;
}

/// 0 where both are the same, or both no number.
double relative_difference(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double scale = std::max(std::abs(a), std::abs(b));
  return std::isfinite(scale) ? std::abs(a - b) / scale : kInfinity;
}

class Columns {
 public:
  Columns(const Run& run, Ledger& ledger) : run_(run), ledger_(ledger) {}

  void compare(const ColumnTree& file, const ColumnTree& made, const std::string& place) {
    for (const std::string& name : made.names) {
      const std::string here = place + "/" + name;
      if (const ColumnTree* group = made.group(name)) {
        if (const ColumnTree* held = file.group(name)) compare(*held, *group, here);
      } else if (const DataColumn* held = file.column(name)) {
        compare_column(*held, *made.column(name), here);
      }
    }
  }

 private:
  void compare_column(const DataColumn& file, const DataColumn& made, const std::string& place) {
    ledger_.beside_poses();
    expect(file.units == made.units, place,
           fmt::format("unit \"{}\", expected \"{}\"", file.units, made.units));
    const auto held = numbers_of(file), expected = numbers_of(made);
    if (held.has_value() != expected.has_value() || file.shape != made.shape)
      return expect(false, place,
                    fmt::format("{} [{}], expected {} [{}]", held ? "numbers" : "texts",
                                fmt::join(file.shape, ", "), expected ? "numbers" : "texts",
                                fmt::join(made.shape, ", ")));
    if (!held)
      return expect(std::get<Texts>(file.values) == std::get<Texts>(made.values), place,
                    "holds other texts than the rest of the file says");
    const std::size_t rows = file.shape.empty() ? 1 : file.shape.front();
    // Points that are pressed and parameters of sensitivities may be as many as there are poses.
    const bool of_poses = place.starts_with("/sweep/") && rows == run_.sweep.poses.size() &&
                          place.find("/pressure/") == std::string::npos &&
                          place.find("/sensitivities/") == std::string::npos;
    for (std::size_t row = 0; row < rows; ++row) {
      if (of_poses) ledger_.at_pose(row, run_.sweep.poses[row].value);
      compare_row(*held, *expected, row, held->size() / rows, place);
    }
  }

  void expect(bool same, const std::string& place, const std::string& words) {
    ledger_.note(Check::kColumns, same ? 0 : kInfinity, place, words);
  }

  void compare_row(const std::vector<double>& held,
                   const std::vector<double>& expected,
                   std::size_t row,
                   std::size_t width,
                   const std::string& place) {
    std::size_t worst = row * width;
    double figure = 0;
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const double difference = relative_difference(held[i], expected[i]);
      if (difference > figure) worst = i, figure = difference;
    }
    if (width == 0) return;
    ledger_.note(Check::kColumns, figure, place,
                 figure == 0
                     ? ""
                     : fmt::format("row {} holds {:.12g}, the rest of the file says {:.12g}", row,
                                   held[worst], expected[worst]));
  }

  const Run& run_;
  Ledger& ledger_;
};

}  // namespace

void check_columns(const ColumnTree& file, const Run& run, Ledger& ledger) {
  Columns(run, ledger).compare(file, columns_of(run), "");
}

}  // namespace condyle::verification
