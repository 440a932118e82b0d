#pragma once

/// Plots as parts of a page.

#include <string>

#include "condyle/pictures/named_plot.h"

namespace condyle {

/// A plot as a figure. Several share one page: `prefix` goes before its own names.
[[nodiscard]] std::string plot_figure(const NamedPlot& plot, const std::string& prefix);

}  // namespace condyle
