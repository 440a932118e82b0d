#include "condyle/pictures/scenery.h"

#include <algorithm>

namespace condyle {

bool shows_arrows(const Scenery& scenery) {
  return !scenery.staging.alone() && !scenery.staging.apart() && !scenery.marks.empty();
}

PageLayout page_layout(int width, int height) {
  const double s = std::min(width / 1200.0, height / 900.0);
  return {width, height, s, {150 * s, 100 * s, width - 235 * s, height - 110 * s}, 44 * s};
}

PageLayout panel_layout(int width, int height) {
  const double s = std::min(width / 1200.0, height / 900.0);
  const double margin = 0.075 * std::min(width, height);
  return {
      width, height, s, {0, 0, static_cast<double>(width), static_cast<double>(height)}, margin};
}

}  // namespace condyle
