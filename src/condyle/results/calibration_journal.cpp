#include "condyle/results/calibration_journal.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "condyle/input_error.h"
#include "condyle/results/format_number.h"

namespace condyle {
namespace {

constexpr std::string_view kWordsOfHead = "condyle calibration ";

std::string head_of(const CalibrationIdentity& identity) {
  return fmt::format("{}1 scene {:016x} surfaces {:016x} table {:016x}\n", kWordsOfHead,
                     identity.run.scene, identity.run.surfaces, identity.table);
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

void expect_same_head(const std::string& file,
                      const std::string& line,
                      const CalibrationIdentity& identity,
                      const Scene& scene) {
  const std::string later = later_format(line, "condyle calibration 1");
  if (!later.empty()) throw InputError(fmt::format("{}: {}", file, later));
  std::istringstream there(line), here(head_of(identity));
  std::string a, b;
  for (const char* what : {"", "", "format", "", "text of the scene", "", "patches", "", "table"}) {
    there >> a;
    here >> b;
    if (a == b) continue;
    const std::string expected = what == std::string("table")
                                     ? scene.calibration->measurements.string()
                                     : scene.file.string();
    throw InputError(fmt::format("{}: belongs to another {}, expected that of {}", file,
                                 *what == '\0' ? "format" : what, expected));
  }
}

}  // namespace

CalibrationIdentity calibration_identity(const Scene& scene,
                                         const std::vector<FittedSurface>& surfaces) {
  return {identity(scene, surfaces), hash_bytes(bytes_of_file(scene.calibration->measurements))};
}

CalibrationContents read_calibration_journal(const std::filesystem::path& path,
                                             const CalibrationIdentity& identity,
                                             const Scene& scene) {
  expect_calibration_journal(path);
  std::istringstream lines(bytes_of_file(path));
  CalibrationContents journal;
  std::string line;
  if (!std::getline(lines, line) || (lines.eof() && head_of(identity).starts_with(line)))
    return journal;
  expect_same_head(path.string(), line, identity, scene);
  journal.whole_bytes = line.size() + 1;
  while (std::getline(lines, line) && !lines.eof()) {
    std::optional<Eigen::VectorXd> theta = theta_of(line);
    if (!theta) break;
    journal.best = std::move(theta);
    journal.whole_bytes += line.size() + 1;
  }
  return journal;
}

void expect_calibration_journal(const std::filesystem::path& path) {
  const std::string text = bytes_of_file(path).substr(0, kWordsOfHead.size());
  if (!kWordsOfHead.starts_with(text))
    throw InputError(path.string() +
                     ": is no journal of a calibration, expected this name to be free for one");
}

CalibrationJournal::CalibrationJournal(LineFile& file,
                                       const CalibrationIdentity& identity,
                                       std::size_t kept_bytes)
    : file_(file), head_(kept_bytes == 0 ? head_of(identity) : "") {
  file_.keep(kept_bytes);
}

void CalibrationJournal::append(const Eigen::VectorXd& theta, double cost) {
  std::string line = fmt::format("best {}", cost);
  for (const double value : theta) line += fmt::format(" {}", value);
  file_.append(head_ + sealed(line));
  head_.clear();
}

}  // namespace condyle
