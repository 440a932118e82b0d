#include "condyle/results/calibration_journal.h"

#include <fmt/format.h>

#include <charconv>
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

/// θ of a line without its end; nothing where the line is torn.
std::optional<Eigen::VectorXd> theta_of(const std::string& line) {
  const std::size_t at = line.rfind(' ');
  if (at == std::string::npos || sealed(line.substr(0, at)) != line + "\n") return std::nullopt;
  std::istringstream words(line.substr(0, at));
  std::string word, cost;
  words >> word >> cost;
  std::vector<double> theta;
  while (words >> word) {
    const char* end = word.data() + word.size();
    const std::from_chars_result read = std::from_chars(word.data(), end, theta.emplace_back());
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  }
  return Eigen::Map<const Eigen::VectorXd>(theta.data(), static_cast<Eigen::Index>(theta.size()));
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
  journal.whole_bytes = read_journal_lines(text, head->bytes, [&](std::string_view line) {
    std::optional<Eigen::VectorXd> theta = theta_of(std::string(line));
    if (!theta) return false;
    journal.best = std::move(theta);
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
