#pragma once

/// Inks and text sizes of a page, in units of its layout: 1 at 1200 x 900.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "condyle/pictures/canvas.h"

namespace condyle {

inline constexpr Rgb kInk = {38, 44, 52};
inline constexpr Rgb kQuiet = {112, 118, 126};
inline constexpr Rgb kLeader = {150, 155, 162};

struct Pen {
  Canvas& canvas;
  double s;
  [[nodiscard]] int size(double points) const {
    return std::max(7, static_cast<int>(std::lround(points * s)));
  }
  [[nodiscard]] TextStyle style(double points, Rgb color = kInk, Align align = Align::kLeft) const {
    return {size(points), color, false, align, 0};
  }
};

inline std::string capitalized(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace condyle
