#pragma once

/// What a command did, for scripts: one JSON object (docs/command-line.md names its members).
/// Angles in deg, lengths in mm, forces in N, times in s; null for a number that is none.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/results/run_file.h"
#include "condyle/verify/verification.h"

namespace condyle {

struct CommandSummary {
  std::string command, version;
  int exit_code = 0;
  double seconds = 0;                             ///< of the whole command
  std::string output;                             ///< the result file written; may be empty
  std::vector<std::string> warnings = {};         ///< beyond those of the run itself
  std::vector<std::filesystem::path> files = {};  ///< pictures and the like that were written
};

[[nodiscard]] std::string json_summary(const CommandSummary& summary, const Run& run);

/// What `condyle verify` found; of the run only its scene and title.
[[nodiscard]] std::string json_verification(const CommandSummary& summary,
                                            const Run& run,
                                            const Verification& verification);

/// {"command": ..., "version": ..., "exit_code": 1, "error": ...}
[[nodiscard]] std::string json_error(const std::string& command,
                                     const std::string& version,
                                     const std::string& error);

/// Whether a line of a fit's notes, or about the start, is a warning.
[[nodiscard]] bool is_warning(const std::string& line);

/// Warnings of fits, with the names of their surfaces; one that several patches of a mesh share is said once.
[[nodiscard]] std::vector<std::string> fit_warnings(const std::vector<const FitReport*>& reports);

/// Warnings of the start and of the fit; one that several patches of a mesh share is said once.
[[nodiscard]] std::vector<std::string> start_and_fit_warnings(const Run& run);

/// What a reader of a run should know: warnings of the start and of the fit, remarks on poses.
[[nodiscard]] std::vector<std::string> run_warnings(const Run& run);

}  // namespace condyle
