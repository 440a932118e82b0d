#pragma once

/// A colour bar with its ticks.

#include <string>

#include "pictures/color_map.h"
#include "pictures/pen.h"

namespace condyle {

struct ColorBar {
  ColorMap map;
  std::string title, unit;
  double low, high;  ///< as shown
};

void draw_color_bar(const Pen& pen, const ColorBar& bar, const Frame& place);

}  // namespace condyle
