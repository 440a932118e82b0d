#include "condyle/pictures/plot_study.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "condyle/pictures/plot_run.h"

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

std::vector<std::filesystem::path> plot_study(const StudyView& study,
                                              const std::filesystem::path& folder,
                                              const std::vector<PlotFormat>& formats,
                                              MapPanels panels) {
  std::vector<std::filesystem::path> written = plot_pages(study_pages(study), folder, formats);
  for (NamedMap& named : study_maps(study)) {
    constexpr std::size_t kWide = 10;  // columns; twice as many could not be read
    if (named.map.columns.size() > kWide) named.map.beside = 1;
    for (const auto& [name, map] : panels == MapPanels::kTogether
                                       ? std::vector<NamedMap>{std::move(named)}
                                       : panel_by_panel(named))
      for (const PlotFormat format : formats) {
        written.push_back(folder / (name + "." + ending(format)));
        plot(map, written.back(), format);
      }
  }
  return written;
}

}  // namespace condyle
