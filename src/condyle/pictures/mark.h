#pragma once

/// What stands in a panel of a chart page: bands, lines, dots, bars, cells of a matrix, in the
/// coordinates of its axes.

#include <string>
#include <vector>

#include "condyle/pictures/image.h"

namespace condyle {

/// Inks of those pages, out of Okabe and Ito's.
inline constexpr const char* kBeforeInk = "#8a9199";
inline constexpr const char* kAfterInk = "#0072B2";
inline constexpr const char* kUnseenInk = "#D55E00";
inline constexpr const char* kMeasuredInk = "#262c34";

struct Mark {
  enum class Kind {
    kBand,  ///< between low and high over x
    kLine,  ///< y over x
    kDots,  ///< y over x, bars of ± high where there is one
    kBars,  ///< from low to high along x, about the row y, half as thick as `size`
    kCells  ///< squares about (x, y) of size 1, each with its own colour
  };
  Kind kind = Kind::kLine;
  std::vector<double> x, y, low = {}, high = {};  ///< NaN: a gap
  std::string ink = kAfterInk;
  bool dashed = false, hollow = false;
  double size = 2;  ///< width of a line, size of a dot, thickness of a bar
  std::vector<Rgb> colors = {};
};

}  // namespace condyle
