#include "condyle/pictures/plot_study.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace condyle {
namespace {

std::vector<NamedMap> panel_by_panel(const NamedMap& named) {
  std::vector<NamedMap> maps;
  for (std::size_t i = 0; i < named.map.panels.size(); ++i) {
    maps.push_back({fmt::format("{}_{}", named.name, i + 1), named.map});
    maps.back().map.panels = {named.map.panels[i]};
  }
  return maps;
}

}  // namespace

std::vector<NamedPage> study_pages(const StudyView& study) {
  std::vector<NamedPage> pages;
  for (const auto& make :
       {study_band_pages, study_knee_pages, study_index_pages, study_failure_pages}) {
    std::vector<NamedPage> more = make(study);
    std::move(more.begin(), more.end(), std::back_inserter(pages));
  }
  return pages;
}

std::vector<NamedPlot> study_plots(const StudyView& study, MapPanels panels) {
  std::vector<NamedPlot> plots = plots_of(study_pages(study));
  for (NamedMap& named : study_maps(study)) {
    constexpr std::size_t kWide = 10;  // columns; twice as many could not be read
    if (named.map.columns.size() > kWide) named.map.beside = 1;
    append(plots, plots_of(panels == MapPanels::kApart ? panel_by_panel(named)
                                                       : std::vector<NamedMap>{std::move(named)}));
  }
  return plots;
}

}  // namespace condyle
