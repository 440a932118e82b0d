#pragma once

#include "condyle/elements/force_law.h"

namespace condyle {

/// Engineering strain of a line of length `length` [mm] from its slack length; 0 where the law has
/// none.
[[nodiscard]] inline double strain(const ForceLaw& law, double length) {
  const double slack = slack_length(law);
  return slack > 0 ? length / slack - 1 : 0;
}

}  // namespace condyle
