#include "equilibrium/diagnosis.h"

namespace condyle {

void explain_failure(const Model& model,
                     NewtonSystem& /*system*/,
                     const EquilibriumState& /*state*/,
                     const Attempt& attempt,
                     PoseResult& result) {
  const NewtonReport& newton = attempt.newton;
  if (model.conditions.size() > kMaxConstraints) {
    result.status = PoseStatus::kSingular;
    result.reason = "more than six conditions: a body has six freedoms";
  } else if (attempt.descent.ran_away) {
    result.status = PoseStatus::kNoEquilibrium;
    result.reason = "the body runs away: nothing carries the load";
  } else if (newton.outcome == NewtonOutcome::kZeroLength) {
    result.status = PoseStatus::kZeroLength;
    result.reason =
        "line element \"" + model.element_names[newton.zero_element] + "\" has no length";
  } else if (newton.outcome == NewtonOutcome::kSingular) {
    result.status = PoseStatus::kSingular;
    result.reason = "conditions and contacts depend on each other, or nothing resists a motion";
  } else if (newton.outcome == NewtonOutcome::kConverged) {
    result.status = PoseStatus::kOverlap;
    result.reason = "no set of contacts was found that carries without overlap or pull";
  } else if (newton.outcome == NewtonOutcome::kDiverged) {
    result.status = PoseStatus::kDiverged;
    result.reason = "Newton's method diverged";
  } else {
    result.status = PoseStatus::kIterationLimit;
    result.reason = "no equilibrium within the iteration limit; last step " +
                    std::to_string(attempt.descent.step) + " mm";
  }
}

}  // namespace condyle
