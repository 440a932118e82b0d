#pragma once

/// Colour maps by their anchor colours: viridis and plasma of matplotlib (van der Walt and Smith
/// 2015), whose lightness rises evenly, so that they survive colour blindness and grey printing;
/// and of ColorBrewer (Brewer 2003), which the colour-blind tell apart, YlGnBu for gaps and RdBu,
/// blue through white to red, for values of both signs.

#include "pictures/image.h"

namespace condyle {

enum class ColorMap {
  kStrain,    ///< plasma without its pale end, which would drown on bone
  kFlexion,   ///< viridis
  kGap,       ///< YlGnBu from its dark end: touching is dark, far apart pale
  kDiverging  ///< RdBu: blue below the middle, red above
};

/// t is clamped to [0, 1].
[[nodiscard]] Rgb map_color(ColorMap map, double t);

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below x (> 0):
/// round ends for scales.
[[nodiscard]] double round_up_nicely(double x);

}  // namespace condyle
