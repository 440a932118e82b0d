#include "condyle/pictures/plot_study.h"

#include <iterator>
#include <utility>

#include "condyle/pictures/plot_run.h"

namespace condyle {

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
                                              std::size_t beside) {
  std::vector<std::filesystem::path> written = plot_pages(study_pages(study), folder, formats);
  for (NamedMap& named : study_maps(study)) {
    constexpr std::size_t kWide = 10;  // columns; twice as many could not be read
    named.map.beside = named.map.columns.size() > kWide ? 1 : beside;
    for (const PlotFormat format : formats) {
      written.push_back(folder / (named.name + "." + ending(format)));
      plot(named.map, written.back(), format);
    }
  }
  return written;
}

}  // namespace condyle
