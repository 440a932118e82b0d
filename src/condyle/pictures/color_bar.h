#pragma once

/// A colour bar with its ticks.

#include <string>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/pen.h"

namespace condyle {

struct ColorBar {
  ColorMap map;
  std::string title, unit;
  double low, high;  ///< as shown
  /// What lies above the upper end: a triangle in its colour with these words beside it; none where
  /// there are none.
  std::string above = {};
};

void draw_color_bar(const Pen& pen, const ColorBar& bar, const Frame& place);

}  // namespace condyle
