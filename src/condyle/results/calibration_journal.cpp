#include "condyle/results/calibration_journal.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <sstream>

namespace condyle {
namespace {

constexpr JournalKind kCalibrationJournal = {"condyle calibration 1", "a calibration"};

JournalParts parts_of(const CalibrationIdentity& identity, const Scene& scene) {
  JournalParts parts = run_parts(identity.run, scene);
  parts.push_back({"table", identity.table,
                   fmt::format("another table, expected that of {}",
                               scene.calibration ? scene.calibration->measurements.string() : "")});
  return parts;
}

/// The hash of a line behind it.
std::string sealed(const std::string& line) {
  return fmt::format("{} {:016x}\n", line, hash_bytes(line));
}

struct CostedNumbers {
  double cost = 0;
  Eigen::VectorXd theta;
};

/// Of a line without its end; nothing where the line is torn.
std::optional<CostedNumbers> numbers_of(const std::string& line) {
  const std::size_t at = line.rfind(' ');
  if (at == std::string::npos || sealed(line.substr(0, at)) != line + "\n") return std::nullopt;
  std::istringstream words(line.substr(0, at));
  std::string word;
  words >> word;
  std::vector<double> numbers;
  while (words >> word) {
    const char* end = word.data() + word.size();
    const std::from_chars_result read = std::from_chars(word.data(), end, numbers.emplace_back());
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  }
  if (numbers.empty()) return std::nullopt;
  return CostedNumbers{
      numbers[0], Eigen::Map<const Eigen::VectorXd>(numbers.data() + 1,
                                                    static_cast<Eigen::Index>(numbers.size()) - 1)};
}

}  // namespace

CalibrationIdentity calibration_identity(const Scene& scene,
                                         const std::vector<FittedSurface>& surfaces) {
  return {identity(scene, surfaces), hash_bytes(bytes_of_file(scene.calibration->measurements))};
}

CalibrationContents read_calibration_journal(const std::filesystem::path& path,
                                             const CalibrationIdentity& identity,
                                             const Scene& scene) {
  const std::string text = bytes_of_file(path);
  const JournalParts parts = parts_of(identity, scene);
  const std::optional<JournalHead> head =
      read_journal_head(path.string(), text, kCalibrationJournal, parts);
  CalibrationContents journal;
  if (!head) return journal;
  expect_same_parts(path.string(), *head, parts);
  // One that went on may have begun with worse ones than it took over.
  double least = std::numeric_limits<double>::infinity();
  journal.whole_bytes = read_journal_lines(text, head->bytes, [&](std::string_view line) {
    std::optional<CostedNumbers> numbers = numbers_of(std::string(line));
    if (!numbers) return false;
    if (journal.best && !(numbers->cost < least)) return true;
    least = numbers->cost;
    journal.best = std::move(numbers->theta);
    return true;
  });
  return journal;
}

void expect_calibration_journal(const std::filesystem::path& path) {
  expect_journal(path, kCalibrationJournal);
}

CalibrationJournal::CalibrationJournal(LineFile& file,
                                       const CalibrationIdentity& identity,
                                       std::size_t kept_bytes)
    : JournalLines(file, kCalibrationJournal, parts_of(identity, Scene()), kept_bytes) {}

void CalibrationJournal::append(const Eigen::VectorXd& theta, double cost) {
  std::string line = fmt::format("best {}", cost);
  for (const double value : theta) line += fmt::format(" {}", value);
  append_line(sealed(line));
}

}  // namespace condyle
