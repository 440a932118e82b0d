#pragma once

/// What tests of plotted pages ask.

#include <string>
#include <vector>

#include "condyle/pictures/plot_study.h"
#include "condyle/pictures/run_program.h"

namespace condyle {

[[nodiscard]] inline bool has_gnuplot() {
  return run_program({"gnuplot", "--version"}, "").exit_code == 0;
}

[[nodiscard]] inline std::vector<std::string> names_of(const std::vector<NamedPage>& pages) {
  std::vector<std::string> names;
  for (const NamedPage& page : pages) names.push_back(page.name);
  return names;
}

}  // namespace condyle
