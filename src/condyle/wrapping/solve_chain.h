#pragma once

/// The shortest path of a chain near the one that it holds.

#include "condyle/wrapping/path_chain.h"

namespace condyle {

/// Places the geodesics; false where one cannot be followed.
bool shoot_links(PathChain& chain);

/// Newton from the geodesics as they are, each step at most 0.3 rad and 0.3 radii of curvature; path
/// errors after it about 1e-15. False where it does not arrive within `most` steps or a piece
/// would run backwards; the chain is then not to be used.
bool solve(PathChain& chain, int most = 60);

[[nodiscard]] double length(const PathChain& chain);

/// B/L: 1 where straight, 0 at a conjugate point, negative past it (then some negative number, where
/// the path is no minimum) [Jacobi; docs/wrapping.md].
[[nodiscard]] double conjugate(const PathChain& chain);

}  // namespace condyle
