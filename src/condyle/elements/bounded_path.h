#pragma once

/// A path that is known to be no longer than so much without being followed: of a strand that is slack
/// nothing else is wanted while a pose is solved.

#include "condyle/elements/line_element.h"

namespace condyle {

class BoundedPath : public LinePath {
 public:
  /// No less than L here, told by `kept`, in which the path was followed elsewhere [mm]; infinite
  /// where that is not known. Of what the path holds while a pose is solved.
  [[nodiscard]] virtual double at_most(const LineEnds& ends,
                                       const RigidTransform& X_BA,
                                       const double* kept) const = 0;
};

/// The element's length here is below the slack length of its law, as far as `kept` tells: force, slope
/// and energy are 0. False where that is not known, and of straight elements.
[[nodiscard]] bool is_surely_slack(const LineElement& element,
                                   const RigidTransform& X_BA,
                                   const double* kept);

}  // namespace condyle
