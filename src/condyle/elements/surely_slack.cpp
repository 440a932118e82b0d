#include "condyle/elements/surely_slack.h"

namespace condyle {

bool is_surely_slack(const LineElement& element, const RigidTransform& X_BA, const double* kept) {
  constexpr double kRoundOff = 1e-9;  // [mm]
  if (!element.path || kept == nullptr) return false;
  const double slack = slack_length(element.law);
  // One that was taut where it was followed last is followed: what bounds its length would cost in vain.
  if (!(slack > 0) || !(element.path->last_length(kept) < slack)) return false;
  return element.path->at_most(ends_of(element, X_BA), X_BA, kept) < slack - kRoundOff;
}

}  // namespace condyle
