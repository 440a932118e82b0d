#pragma once

/// One row of a table of measurements, from its fields.

#include <string>
#include <vector>

#include "condyle/calibration/csv_file.h"
#include "condyle/calibration/measurement_table.h"

namespace condyle {

/// Where the columns of a table stand, by the names of its header.
class MeasurementColumns {
 public:
  /// Throws InputError for a column that is unknown, there twice or missing.
  explicit MeasurementColumns(const CsvFile& csv);

  [[nodiscard]] bool has(const std::string& column) const { return find(column) >= 0; }
  /// Empty for a column that the table does not have.
  [[nodiscard]] std::string text(const CsvRow& row, const std::string& column) const;
  [[nodiscard]] double number(const CsvRow& row,
                              const std::string& column,
                              const std::string& expected) const;
  /// "knee.csv:7: sd = 0, expected ...".
  [[noreturn]] void fail(const CsvRow& row,
                         const std::string& column,
                         const std::string& expected) const;

 private:
  [[nodiscard]] int find(const std::string& column) const;

  std::string file_;
  std::vector<std::string> names_;
};

/// Of the column `use`; fitted where there is none.
[[nodiscard]] MeasuredUse use_of(const CsvRow& row, const MeasurementColumns& columns);

/// Throws InputError as read_measurements does for what one row alone cannot mean.
[[nodiscard]] Measurement read_measurement(const CsvRow& row,
                                           const MeasurementColumns& columns,
                                           const Scene& scene);

}  // namespace condyle
