#pragma once

/// Curves of some runs as a small drawing (SVG) within the page: its letters, its colours by light and
/// dark (page.css), a line style for each run. No program is asked for it.

#include <optional>
#include <string>
#include <vector>

#include "condyle/pictures/gnuplot.h"

namespace condyle {

struct SvgCurves {
  std::string what;     ///< for those who do not see it
  std::string x_label;  ///< below the axis, with units
  bool from_zero = false;
  std::vector<std::optional<Curve>> of_runs;  ///< the place in the list chooses colour and dashes
};

/// Nothing where no curve has a point.
[[nodiscard]] std::string svg(const SvgCurves& curves);

/// A short line in colour and dashes of a run, for legends.
[[nodiscard]] std::string svg_swatch(std::size_t run);

}  // namespace condyle
