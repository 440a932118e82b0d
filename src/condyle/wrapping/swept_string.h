#pragma once

/// A string that passed clear of a surface and is straight elsewhere now: was it drawn through the surface on
/// the straight way between, and does it hang on it since?

#include <optional>

#include "condyle/wrapping/one_surface.h"
#include "condyle/wrapping/straight_piece.h"

namespace condyle {

/// The string from U to V, its ends drawn straight from `from` to `to` in steps of a quarter of the surface's
/// least radius at most: where it lies on the surface at the end. Nothing where it comes clear, slips off
/// (B <= 0) or an end passes through the surface on the way; and where the way is longer than 64 steps.
[[nodiscard]] std::optional<ArcPlace> swept_onto(const WrapShape& shape,
                                                 const StraightPiece& from,
                                                 const StraightPiece& to);

/// No: the ends have moved less than the clearance [mm] of the string where it is now.
[[nodiscard]] bool comes_clear(const StraightPiece& from,
                               const StraightPiece& to,
                               double clearance);

}  // namespace condyle
