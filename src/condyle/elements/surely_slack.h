#pragma once

/// Line elements that a bound of their paths (LinePath::at_most) shows to be slack: nothing else is
/// wanted of them while a pose is solved.

#include "condyle/elements/line_element.h"

namespace condyle {

/// The element's length here is below the slack length of its law, as far as `kept` tells: force, slope
/// and energy are 0. False where that is not known, and of straight elements.
[[nodiscard]] bool is_surely_slack(const LineElement& element,
                                   const RigidTransform& X_BA,
                                   const double* kept);

}  // namespace condyle
