#pragma once

/// Charts of several runs over each other: a colour for each quantity, a line style for each run.

#include <string>
#include <vector>

#include "condyle/pictures/run_charts.h"

namespace condyle {

struct NamedRun {
  std::string name;  ///< in the legend
  const Run* run = nullptr;
};

/// Charts by name, panels by what their ordinate is, curves by title; panels with many curves are
/// divided, so that no colour stands for two. Throws InputError where the runs sweep different
/// quantities or one has no poses.
[[nodiscard]] std::vector<NamedChart> overlay(const std::vector<NamedRun>& runs);

}  // namespace condyle
