#include <fmt/format.h>

#include "condyle/pictures/plot_study.h"
#include "condyle/report/html.h"
#include "condyle/report/plot_figures.h"
#include "condyle/report/study_page.h"
#include "condyle/results/temporary_folder.h"

namespace condyle {

std::string study_plot_section(const StudyView& study) {
  const TemporaryFolder folder;
  std::string body;
  int count = 0;
  for (const auto& file : plot_study(study, folder.path(), {PlotFormat::kSvg}, MapPanels::kApart))
    body += plot_figure(file, fmt::format("plot{}-", ++count));
  return section("plots", "Plots", body);
}

}  // namespace condyle
