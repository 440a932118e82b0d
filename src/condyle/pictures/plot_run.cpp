#include "condyle/pictures/plot_run.h"

#include <utility>

#include "condyle/pictures/plot_comparison.h"

namespace condyle {
std::vector<std::filesystem::path> plot_charts(const std::vector<NamedChart>& charts,
                                               const std::filesystem::path& folder,
                                               const std::vector<PlotFormat>& formats) {
  std::vector<std::filesystem::path> written;
  for (const auto& [name, chart] : charts) {
    for (const PlotFormat format : formats) {
      if (chart.panels.empty()) continue;
      written.push_back(folder / (name + "." + ending(format)));
      plot(chart, written.back(), format);
    }
  }
  return written;
}

std::vector<std::filesystem::path> plot_run(const Run& run,
                                            const std::filesystem::path& folder,
                                            const std::vector<PlotFormat>& formats) {
  std::vector<NamedChart> charts = run_charts(run);
  for (NamedChart& chart : comparison_charts(run)) charts.push_back(std::move(chart));
  if (run.laxity()) charts.push_back({"laxity", laxity_chart(run)});
  return plot_charts(charts, folder, formats);
}

}  // namespace condyle
