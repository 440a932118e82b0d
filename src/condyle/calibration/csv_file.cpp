#include "condyle/calibration/csv_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include "condyle/calibration/csv_text.h"
#include "condyle/input_error.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

std::string text_of_table(const std::filesystem::path& file, const std::string& expected) {
  const std::string name = file.string();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw InputError(fmt::format("{}: no such file, expected {}", name, expected));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: is a folder, expected {}", name, expected));
  if (!std::filesystem::is_regular_file(status))  // one that is read twice, its digest being kept
    throw InputError(fmt::format("{}: is no plain file, expected {}", name, expected));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
    throw InputError(
        fmt::format("{}: cannot be read, expected {} that is not empty", name, expected));
  if (text.str().find('\0') != std::string::npos)
    throw InputError(fmt::format("{}: is no text in UTF-8, expected {}", name, expected));
  return text.str();
}

std::string trimmed(const std::string& text) {
  constexpr const char* kBlank = " \t";
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
  const std::size_t start = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  std::vector<std::string> lines(1);
  for (std::size_t i = start; i < text.size(); ++i) {
    const bool crlf = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (crlf) continue;
    if (text[i] == '\n' || text[i] == '\r')
      lines.emplace_back();
    else
      lines.back() += text[i];
  }
  return lines;
}

/// The apostrophe of csv_text.h, which is none of the text.
std::string without_guard(std::string field) {
  if (field.size() > 1 && field[0] == '\'' &&
      kGuardedStarts.find(field[1]) != std::string_view::npos)
    field.erase(0, 1);
  return field;
}

/// The field that begins at `at`, which then stands behind the comma after it, or behind the end. False
/// for a quote that is not closed, or with more than blanks after it.
bool take_field(const std::string& line, std::size_t& at, std::string& field) {
  const std::size_t first = std::min(line.find_first_not_of(" \t", at), line.size());
  if (first == line.size() || line[first] != '"') {
    const std::size_t end = std::min(line.find(',', at), line.size());
    field = without_guard(trimmed(line.substr(at, end - at)));
    at = end + 1;
    return true;
  }
  field.clear();
  for (at = first + 1; at < line.size(); ++at) {
    const bool doubled = line[at] == '"' && at + 1 < line.size() && line[at + 1] == '"';
    if (line[at] == '"' && !doubled) break;
    field += line[at];
    if (doubled) ++at;
  }
  if (at >= line.size()) return false;
  field = without_guard(std::move(field));
  const std::size_t end = std::min(line.find(',', at), line.size());
  const bool closed = trimmed(line.substr(at + 1, end - at - 1)).empty();
  at = end + 1;
  return closed;
}

CsvRow row_of(const std::string& line, int number, const std::filesystem::path& file) {
  CsvRow row;
  row.line = number;
  for (std::size_t at = 0; at <= line.size();) {
    std::string field;
    if (!take_field(line, at, field))
      throw InputError(fmt::format("{}:{}: a quote in column {} is not closed, expected \"...\"",
                                   file.string(), number, row.fields.size() + 1));
    row.fields.push_back(field);
  }
  return row;
}

}  // namespace

CsvFile read_csv(const std::filesystem::path& file, const std::string& expected) {
  CsvFile csv;
  csv.file = file;
  const std::vector<std::string> lines = lines_of(text_of_table(file, expected));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string text = trimmed(lines[i]);
    const int line = static_cast<int>(i) + 1;
    if (text.starts_with('#')) csv.comments.push_back({line, trimmed(text.substr(1))});
    if (text.empty() || text[0] == '#') continue;
    CsvRow row = row_of(lines[i], line, file);
    if (csv.header.line == 0) {
      csv.header = std::move(row);
      continue;
    }
    if (row.fields.size() != csv.header.fields.size())
      throw InputError(fmt::format("{}:{}: {} fields, expected {} as in the header on line {}",
                                   file.string(), row.line, row.fields.size(),
                                   csv.header.fields.size(), csv.header.line));
    csv.rows.push_back(std::move(row));
  }
  if (csv.header.line == 0)
    throw InputError(fmt::format("{}: holds no line, expected {}", file.string(), expected));
  return csv;
}

double csv_number(const std::string& field) {
  const char* end = field.data() + field.size();
  const char* begin = field.data() + (field.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  const bool whole = error == std::errc() && stop == end && begin != end;
  return whole && std::isfinite(number) ? number : kNoNumber;
}

}  // namespace condyle
