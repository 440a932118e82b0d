#include "condyle/pictures/named_plot.h"

#include <iterator>

#include "condyle/pictures/gnuplot_page.h"

namespace condyle {

void append(std::vector<NamedPlot>& plots, std::vector<NamedPlot> more) {
  std::move(more.begin(), more.end(), std::back_inserter(plots));
}

std::vector<std::filesystem::path> write_plots(const std::vector<NamedPlot>& plots,
                                               const std::filesystem::path& folder,
                                               const std::vector<PlotFormat>& formats) {
  std::vector<std::filesystem::path> written;
  for (const NamedPlot& plot : plots)
    for (const PlotFormat format : formats) {
      written.push_back(folder / (plot.name + "." + ending(format)));
      draw_script(plot.script(format), written.back());
    }
  return written;
}

std::string svg_of(const NamedPlot& plot) {
  return drawn(plot.script(PlotFormat::kSvg), plot.name + ".svg");
}

}  // namespace condyle
