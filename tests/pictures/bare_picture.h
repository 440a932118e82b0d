#pragma once

#include "condyle/pictures/knee_picture.h"

namespace condyle {

/// Without words and scales.
inline constexpr PictureOptions kBare = {600, 450, false};

[[nodiscard]] inline bool is_white(Rgb c) { return c[0] > 252 && c[1] > 252 && c[2] > 252; }

}  // namespace condyle
