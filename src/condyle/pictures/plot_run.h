#pragma once

/// The plots of a run. What they show is in run_charts.h, and for runs with a reference model or a test
/// of laxity in plot_comparison.h, for calibrations in plot_calibration.h.

#include <vector>

#include "condyle/pictures/chart_page.h"
#include "condyle/pictures/gnuplot.h"
#include "condyle/pictures/named_plot.h"
#include "condyle/pictures/overlay.h"
#include "condyle/pictures/run_charts.h"

namespace condyle {

/// All of them.
[[nodiscard]] std::vector<NamedPlot> run_plots(const Run& run);

/// Charts of all kinds, without the map of its sensitivities.
[[nodiscard]] std::vector<NamedChart> all_charts(const Run& run);
/// Those that have a panel.
[[nodiscard]] std::vector<NamedPlot> chart_plots(std::vector<NamedChart> charts);

/// None of a run of another kind.
[[nodiscard]] std::vector<NamedPage> calibration_pages(const Run& run);

}  // namespace condyle
