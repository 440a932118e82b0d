#include "condyle/pictures/plot_run.h"

#include <utility>

#include "condyle/pictures/plot_calibration.h"
#include "condyle/pictures/plot_comparison.h"
#include "condyle/pictures/sensitivity_map.h"

namespace condyle {

std::vector<NamedChart> all_charts(const Run& run) {
  std::vector<NamedChart> charts = run_charts(run);
  for (NamedChart& chart : comparison_charts(run)) charts.push_back(std::move(chart));
  if (run.laxity()) charts.push_back({"laxity", laxity_chart(run)});
  return charts;
}

std::vector<NamedPlot> chart_plots(std::vector<NamedChart> charts) {
  std::erase_if(charts, [](const NamedChart& named) { return named.chart.panels.empty(); });
  return plots_of(std::move(charts));
}

std::vector<NamedPage> calibration_pages(const Run& run) {
  if (run.calibration() == nullptr) return {};
  return calibration_pages(run.scene, *run.calibration());
}

std::vector<NamedPlot> run_plots(const Run& run) {
  std::vector<NamedPlot> plots = chart_plots(all_charts(run));
  append(plots, sensitivity_plots(run));
  append(plots, plots_of(calibration_pages(run)));
  return plots;
}

}  // namespace condyle
