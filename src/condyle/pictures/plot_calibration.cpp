#include "condyle/pictures/plot_calibration.h"

#include <iterator>
#include <utility>

#include "condyle/calibration/calibration.h"

namespace condyle {

std::vector<NamedPage> calibration_pages(const Scene& scene, const CalibrationResult& result) {
  std::vector<NamedPage> pages;
  for (const auto& make : {measured_pages, residual_pages, parameter_pages, spectrum_pages,
                           profile_pages, band_pages, suggestion_pages}) {
    std::vector<NamedPage> more = make(scene, result);
    std::move(more.begin(), more.end(), std::back_inserter(pages));
  }
  return pages;
}

}  // namespace condyle
