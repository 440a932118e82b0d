#pragma once

/// Plots by the names of their files: each becomes a file in one format or several, or a part of a page.

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "condyle/pictures/plot_format.h"

namespace condyle {

struct NamedPlot {
  std::string name;                               ///< of the file, without its ending
  std::function<std::string(PlotFormat)> script;  ///< what gnuplot draws it by
};

/// Of charts, pages or maps with their names.
template <class Named>
[[nodiscard]] std::vector<NamedPlot> plots_of(std::vector<Named> all) {
  std::vector<NamedPlot> plots;
  for (Named& named : all) {
    auto& [name, shown] = named;
    plots.push_back({std::move(name), [shown = std::move(shown)](PlotFormat format) {
                       return gnuplot_script(shown, format);
                     }});
  }
  return plots;
}

void append(std::vector<NamedPlot>& plots, std::vector<NamedPlot> more);

/// Draws them into `folder`, in every format, and returns the paths. Throws as draw_script does (gnuplot_page.h).
std::vector<std::filesystem::path> write_plots(const std::vector<NamedPlot>& plots,
                                               const std::filesystem::path& folder,
                                               const std::vector<PlotFormat>& formats);

/// As the text of an SVG.
[[nodiscard]] std::string svg_of(const NamedPlot& plot);

}  // namespace condyle
