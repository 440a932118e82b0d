#include "condyle/elements/surely_slack.h"

namespace condyle {

bool is_surely_slack(const LineElement& element, const RigidTransform& X_BA, const double* kept) {
  constexpr double kRoundOff = 1e-9;  // [mm]
  if (!element.path || kept == nullptr) return false;
  const double slack = slack_length(element.law);
  return slack > 0 && element.path->at_most(ends_of(element, X_BA), X_BA, kept) < slack - kRoundOff;
}

}  // namespace condyle
