#pragma once

/// A file of comma-separated values as text: what spreadsheets and scripts write. Lines may end as on
/// any system, begin with a byte order mark, be blank or comments (#); fields may be quoted ("a, b", ""
/// within is one quote) and stand between blanks.

#include <filesystem>
#include <string>
#include <vector>

namespace condyle {

struct CsvRow {
  int line = 0;  ///< of the file, from 1
  std::vector<std::string> fields;
};

struct CsvComment {
  int line = 0;      ///< of the file, from 1
  std::string text;  ///< behind the #, without blanks around it
};

struct CsvFile {
  std::filesystem::path file;
  std::vector<CsvComment> comments;
  CsvRow header;
  std::vector<CsvRow> rows;  ///< each with as many fields as the header
};

/// `expected` is a noun: "a table of measurements (CSV)". Throws InputError with file and line where
/// it cannot be read, is empty or no text, where a quote is not closed or a row has another number of
/// fields than the header.
[[nodiscard]] CsvFile read_csv(const std::filesystem::path& file, const std::string& expected);

/// The number that a field is as a whole, "4.9", "+4.9" or "1e-3"; NaN for anything else, and for what
/// is not finite.
[[nodiscard]] double csv_number(const std::string& field);

}  // namespace condyle
