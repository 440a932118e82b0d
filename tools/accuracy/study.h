#pragma once

/// The studies of tools/accuracy.sh. Each writes tables (CSV) into a folder and fills its part of
/// docs/accuracy.md.

#include <fmt/os.h>

#include <filesystem>
#include <string>
#include <vector>

namespace condyle::accuracy {

struct Setting {
  std::filesystem::path folder;  ///< to write into
  std::filesystem::path root;    ///< of the project
  [[nodiscard]] fmt::ostream table(const std::string& name) const {
    return fmt::output_file((folder / (name + ".csv")).string());
  }
};

struct Study {
  std::string page;                   ///< Markdown
  std::vector<std::string> in_short;  ///< what a hurried reader should know, a sentence or two each
  std::vector<std::string> broken;    ///< what was to hold and does not
  void require(bool holds, const std::string& what) {
    if (!holds) broken.push_back(what);
  }
};

/// Error of fitted patches against control points, degree and noise, on shapes known exactly.
[[nodiscard]] Study study_surfaces(const Setting& setting);

/// The smoothing that the program chooses beside the best one made knowing the truth.
[[nodiscard]] Study study_smoothing(const Setting& setting);

/// Newton's convergence, error against tolerance and time, and other solvers on the same equations.
[[nodiscard]] Study study_solvers(const Setting& setting);

/// From meshes of the phantom to swept poses, against the same sweep on its exact surfaces.
[[nodiscard]] Study study_whole_way(const Setting& setting);

/// What each part of a scene costs in time and memory, and that what is not used costs nothing.
[[nodiscard]] Study study_parts(const Setting& setting);

/// How the cost grows with poses, ligaments, contacts and control points.
[[nodiscard]] Study study_growth(const Setting& setting);

/// The hard cases: status, iterations, residual, condition, error.
[[nodiscard]] Study study_hard_cases(const Setting& setting);

}  // namespace condyle::accuracy
