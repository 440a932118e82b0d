#pragma once

/// Plots as files. What they show is in run_charts.h, and for runs with a reference model or a test
/// of laxity in plot_comparison.h, for calibrations in plot_calibration.h.

#include <filesystem>
#include <vector>

#include "condyle/pictures/chart_page.h"
#include "condyle/pictures/gnuplot.h"
#include "condyle/pictures/overlay.h"
#include "condyle/pictures/run_charts.h"

namespace condyle {

/// Writes the charts of a run into `folder`, in every format, and returns the paths. Charts without
/// a curve are left out.
std::vector<std::filesystem::path> plot_run(const Run& run,
                                            const std::filesystem::path& folder,
                                            const std::vector<PlotFormat>& formats);

/// Those of all kinds, without the map of its sensitivities.
[[nodiscard]] std::vector<NamedChart> all_charts(const Run& run);

std::vector<std::filesystem::path> plot_charts(const std::vector<NamedChart>& charts,
                                               const std::filesystem::path& folder,
                                               const std::vector<PlotFormat>& formats);

/// None of a run of another kind.
[[nodiscard]] std::vector<NamedPage> calibration_pages(const Run& run);
std::vector<std::filesystem::path> plot_pages(const std::vector<NamedPage>& pages,
                                              const std::filesystem::path& folder,
                                              const std::vector<PlotFormat>& formats);

}  // namespace condyle
