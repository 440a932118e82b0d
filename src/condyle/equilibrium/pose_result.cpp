#include "condyle/equilibrium/pose_result.h"

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
  }
  return "unknown";
}

const char* name(EventKind kind) {
  switch (kind) {
    case EventKind::kClosing:
      return "closing";
    case EventKind::kOpening:
      return "opening";
    case EventKind::kJump:
      return "jump";
    case EventKind::kLeavingPatch:
      return "leaving patch";
    case EventKind::kReturningToPatch:
      return "returning to patch";
    case EventKind::kLimitPoint:
      return "limit point";
  }
  return "unknown";
}

void to_file_frames(const BodyOrigins& origins, PoseResult& pose) {
  pose.X_BA = origins.out_of_model(pose.X_BA);
  for (ContactResult& contact : pose.contacts) {
    contact.resultant_ground += origins.B;
    for (ContactPointResult& point : contact.points) {
      point.point_ground += origins.B;
      point.point_moving += origins.A;
    }
  }
}

}  // namespace condyle
