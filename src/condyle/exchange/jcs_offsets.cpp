#include "condyle/exchange/jcs_offsets.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "condyle/calibration/csv_file.h"
#include "condyle/exchange/jcs_heading.h"
#include "condyle/file_ending.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

std::string bare(std::string text) {
  std::erase(text, '"');
  std::erase(text, '\r');
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

struct Entry {
  int line = 0;
  std::string value;
};

/// The entries of [Knee JCS], without quotes.
std::map<std::string, Entry> knee_section(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError(file.string() + ": cannot be read, expected State.cfg of a robot");
  std::map<std::string, Entry> entries;
  bool inside = false;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string text = bare(line);
    if (text.starts_with('[')) inside = text == "[Knee JCS]";
    const std::size_t equals = text.find('=');
    if (inside && equals != std::string::npos)
      entries[bare(text.substr(0, equals))] = {number, bare(text.substr(equals + 1))};
  }
  return entries;
}

const Entry& entry(const std::map<std::string, Entry>& entries,
                   const std::string& key,
                   const std::filesystem::path& file) {
  const auto found = entries.find(key);
  if (found == entries.end())
    throw InputError(fmt::format("{}: no \"{}\" in [Knee JCS], expected one", file.string(), key));
  return found->second;
}

/// Of "6 a b c d e f": a count first, then as many numbers.
std::vector<double> six_numbers(const Entry& entry, const std::filesystem::path& file) {
  std::istringstream words(entry.value);
  std::vector<double> numbers;
  std::string word;
  words >> word;
  bool six = csv_number(word) == 6;
  while (words >> word) numbers.push_back(csv_number(word));
  six = six && numbers.size() == 6;
  for (const double number : numbers) six = six && std::isfinite(number);
  if (!six)
    throw InputError(
        fmt::format("{}:{}: Position Offset (m,rad) = {}, expected 6, their count, and six "
                    "numbers",
                    file.string(), entry.line, entry.value));
  return numbers;
}

std::array<double, 6> offsets_of_state(const std::filesystem::path& file) {
  const std::map<std::string, Entry> entries = knee_section(file);
  const std::vector<double> numbers =
      six_numbers(entry(entries, "Position Offset (m,rad)", file), file);
  std::array<double, 6> offsets{};
  std::array<bool, 6> told{};
  for (std::size_t i = 0; i < 6; ++i) {
    const bool angle = i >= 3;
    const Entry& name = entry(entries, fmt::format("Channel Names {}", i), file);
    const auto motion =
        motion_of_heading(fmt::format("Knee JCS {} [{}]", name.value, angle ? "deg" : "mm"));
    if (!motion || told[motion->coordinate])
      throw InputError(
          fmt::format("{}:{}: Channel Names {} = {}, expected another motion of the "
                      "knee: three shifts, then three turns",
                      file.string(), name.line, i, name.value));
    told[motion->coordinate] = true;
    offsets[motion->coordinate] = motion->sign * numbers[i] * (angle ? 180 / M_PI : 1000);
  }
  return offsets;
}

std::array<double, 6> offsets_of_table(const std::filesystem::path& file) {
  const CsvFile csv = read_csv(file, "offsets of kinematics (CSV)");
  if (csv.rows.size() != 1)
    throw InputError(
        fmt::format("{}: {} rows, expected one of offsets", file.string(), csv.rows.size()));
  std::array<double, 6> offsets{};
  std::array<bool, 6> told{};
  for (std::size_t i = 0; i < csv.header.fields.size(); ++i) {
    const std::string& heading = csv.header.fields[i];
    if (heading.empty() && i == 0) continue;  // numbers of rows
    const auto motion = motion_of_heading(heading);
    if (!motion)
      throw InputError(
          fmt::format("{}:{}: unknown column \"{}\", expected \"Knee JCS Medial [mm]\" "
                      "or another motion",
                      file.string(), csv.header.line, heading));
    if (told[motion->coordinate])
      throw InputError(fmt::format("{}:{}: two columns of the motion of \"{}\", expected one",
                                   file.string(), csv.header.line, heading));
    told[motion->coordinate] = true;
    const double number = csv_number(csv.rows[0].fields[i]);
    if (std::isnan(number))
      throw InputError(fmt::format("{}:{}: {} = {}, expected a finite number", file.string(),
                                   csv.rows[0].line, heading, csv.rows[0].fields[i]));
    offsets[motion->coordinate] = motion->sign * number;
  }
  return offsets;
}

}  // namespace

std::array<double, 6> read_jcs_offsets(const std::filesystem::path& file) {
  return file_ending(file) == ".csv" ? offsets_of_table(file) : offsets_of_state(file);
}

}  // namespace condyle
