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

std::vector<NamedPage> calibration_pages(const Run& run) {
  if (run.calibration() == nullptr) return {};
  return calibration_pages(run.scene, *run.calibration());
}

std::vector<std::filesystem::path> plot_pages(const std::vector<NamedPage>& pages,
                                              const std::filesystem::path& folder,
                                              const std::vector<PlotFormat>& formats) {
  std::vector<std::filesystem::path> written;
  for (const NamedPage& page : pages)
    for (const PlotFormat format : formats) {
      written.push_back(folder / (page.name + "." + ending(format)));
      plot(page.page, written.back(), format);
    }
  return written;
}

std::vector<std::filesystem::path> plot_run(const Run& run,
                                            const std::filesystem::path& folder,
                                            const std::vector<PlotFormat>& formats) {
  std::vector<std::filesystem::path> written = plot_charts(all_charts(run), folder, formats);
  for (std::filesystem::path& file : plot_sensitivities(run, folder, formats))
    written.push_back(std::move(file));
  for (std::filesystem::path& file : plot_pages(calibration_pages(run), folder, formats))
    written.push_back(std::move(file));
  return written;
}

}  // namespace condyle
