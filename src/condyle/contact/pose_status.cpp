#include "condyle/contact/pose_status.h"

namespace condyle {

const char* name(PoseStatus status) {
  switch (status) {
    case PoseStatus::kConverged:
      return "converged";
    case PoseStatus::kIterationLimit:
      return "iteration limit";
    case PoseStatus::kDiverged:
      return "diverged";
    case PoseStatus::kSingular:
      return "singular";
    case PoseStatus::kLeftPatch:
      return "left patch";
    case PoseStatus::kNoEquilibrium:
      return "no equilibrium";
    case PoseStatus::kZeroLength:
      return "zero length";
    case PoseStatus::kOverlap:
      return "overlap";
    case PoseStatus::kNotComputed:
      return "not computed";
    case PoseStatus::kNoPath:
      return "no path";
  }
  return "unknown";
}

}  // namespace condyle
