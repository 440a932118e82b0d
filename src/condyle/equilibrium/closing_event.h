#pragma once

/// Where on a sweep a point of contact closes, beyond what comparing poses can tell: a contact is
/// added from a small overlap on only (kAllowedOverlap), and until then its gap says better
/// where it was zero.

#include <optional>
#include <vector>

#include "condyle/equilibrium/walker.h"

namespace condyle {

/// The swept value at which the gap of a point that `after` carries with and `before` does not
/// vanishes on the way through `earlier` and `before`, which have the same contacts; of several
/// points the one nearest to `before`. Nothing where no such gap closes. `searches`: one for each pair.
[[nodiscard]] std::optional<double> closing_value(const Model& model,
                                                  const std::vector<ContactSearch>& searches,
                                                  const SolvedPose& earlier,
                                                  const SolvedPose& before,
                                                  const SolvedPose& after);

}  // namespace condyle
