#pragma once

/// Colour maps by their anchor colours: viridis and plasma of matplotlib (van der Walt and Smith
/// 2015), whose lightness rises evenly, so that they survive colour blindness and grey printing;
/// and of ColorBrewer (Brewer 2003), which the colour-blind tell apart, YlGnBu for gaps, PuRd for pressures and RdBu,
/// blue through white to red, for values of both signs.

#include "condyle/pictures/image.h"

namespace condyle {

enum class ColorMap {
  kStrain,    ///< plasma without its pale end, which would drown on bone
  kFlexion,   ///< viridis
  kGap,       ///< YlGnBu from its dark end: touching is dark, far apart pale
  kPressure,  ///< PuRd without its palest end, which would drown on cartilage
  kDiverging  ///< RdBu: blue below the middle, red above
};

/// What is wrong in a picture, overlap or a contact beyond an edge: a red outside of every map
/// above, which the colour-blind see as a dark yellow where the gap map is blue or pale.
inline constexpr Rgb kAlarmColor = {214, 56, 20};

/// t is clamped to [0, 1].
[[nodiscard]] Rgb map_color(ColorMap map, double t);

}  // namespace condyle
