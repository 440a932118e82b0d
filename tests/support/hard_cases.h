#pragma once

/// Scenes that are hard on a solver, with the behaviour expected of each: one table for the tests
/// and for tools/accuracy.sh.

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "condyle/equilibrium/pose_result.h"

namespace condyle::hard {

struct HardCase {
  std::string name;
  std::string file;                                          ///< of data/hard
  std::vector<std::pair<std::string, std::string>> changes;  ///< of the scene's text, each once
  std::string why;                                           ///< it is hard
  std::string wanted;                                        ///< what has to happen
  /// The statuses as a regular expression, a letter per pose: c converged, l left patch, n no
  /// equilibrium, s singular, z zero length, o overlap, i iteration limit, d diverged.
  std::string expected;
  double tolerance = 0;  ///< of the error below
  /// Largest error of the poses that have an answer against the truth: lengths in units of the
  /// model's own, forces of the load. Empty where no pose is to converge.
  std::function<double(const SweepResult&)> error;
  std::string words;  ///< that the reason or the remark of some pose holds
  int steps = 0;      ///< where not 0: the truth is the end of the sweep in so many steps
};

[[nodiscard]] std::vector<HardCase> hard_cases();

struct HardOutcome {
  SweepResult sweep;
  std::string statuses;  ///< as HardCase::expected
  int iterations = 0;    ///< most of a pose
  double residual = 0;   ///< largest of a converged pose [N]
  double condition = 0;  ///< of Newton's matrix at the last pose that converged, rows in N and mm
  double error = 0;
  bool finite = true;  ///< no converged pose holds a number that is none
  bool has_words = false;
  [[nodiscard]] bool as_expected(const HardCase& hard) const;  ///< the statuses
};

/// Runs the case; `root` is the folder of the project.
[[nodiscard]] HardOutcome run(const HardCase& hard, const std::filesystem::path& root);

}  // namespace condyle::hard
