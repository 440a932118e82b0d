#pragma once

/// Runs laid over each other: the curves that they have in common, and how far they are from those of
/// the first run.

#include <optional>
#include <string>
#include <vector>

#include "condyle/pictures/gnuplot.h"
#include "condyle/report/curve_difference.h"
#include "condyle/results/run_file.h"

namespace condyle {

inline constexpr std::size_t kMostComparedRuns = 6;

struct ComparedRun {
  std::string name;  ///< by which people know it
  std::string file;
  const Run* run = nullptr;
};

/// One quantity of all runs.
struct ComparedCurve {
  std::string group;  ///< what it is, with units: "Contact force [N]"
  std::string name;   ///< whose: "medial"; may be empty
  bool from_zero = false;
  std::vector<std::optional<Curve>> of;  ///< by run; nothing where the run has no such value
  /// Of each run from the first one; nothing of the first itself, where one of the two has no such
  /// curve, or where one goes to and fro.
  std::vector<std::optional<CurveDifference>> differences;
};

struct RunComparison {
  std::vector<ComparedRun> runs;
  std::string axis;            ///< of the first run, with units: "Flexion [°]"
  std::vector<bool> overlaid;  ///< which runs go over it
  std::vector<ComparedCurve> curves;
};

/// What stands in the brackets of a label: "N" of "Contact force [N]"; and what before them.
[[nodiscard]] std::string units_of(const std::string& label);
[[nodiscard]] std::string without_units(const std::string& label);
/// Within a sentence.
[[nodiscard]] std::string with_small_letter(std::string text);

/// Throws InputError for fewer than two or more than kMostComparedRuns runs, a run without poses, and
/// one that sweeps what the first sweeps in other units.
[[nodiscard]] RunComparison compare_runs(const std::vector<ComparedRun>& runs);

/// In all runs, wherever it has a value.
[[nodiscard]] bool is_zero(const ComparedCurve& curve);

}  // namespace condyle
