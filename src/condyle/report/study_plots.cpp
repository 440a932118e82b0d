#include <fmt/format.h>

#include "condyle/pictures/plot_study.h"
#include "condyle/report/html.h"
#include "condyle/report/plot_figures.h"
#include "condyle/report/study_page.h"

namespace condyle {

std::string study_plot_section(const StudyView& study) {
  std::string body;
  int count = 0;
  for (const NamedPlot& plot : study_plots(study, MapPanels::kApart))
    body += plot_figure(plot, fmt::format("plot{}-", ++count));
  return section("plots", "Plots", body);
}

}  // namespace condyle
