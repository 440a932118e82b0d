#include "condyle/equilibrium/pose_trace.h"

#include <fmt/format.h>

namespace condyle {

const char* name(PoseRoute route) {
  switch (route) {
    case PoseRoute::kNone:
      break;
    case PoseRoute::kNewton:
      return "Newton";
    case PoseRoute::kDescent:
      return "descent";
    case PoseRoute::kParts:
      return "in parts";
    case PoseRoute::kPartsDescents:
      return "in parts, with descents";
  }
  return "none";
}

const char* name(PoseOrigin origin) {
  switch (origin) {
    case PoseOrigin::kNone:
      break;
    case PoseOrigin::kStart:
      return "the start pose of the scene";
    case PoseOrigin::kPrediction:
      return "the poses before it, extrapolated";
    case PoseOrigin::kLastPose:
      return "the pose before it";
    case PoseOrigin::kCarriedStart:
      return "the start pose of the scene, carried to the values asked for";
    case PoseOrigin::kCarriedLast:
      return "the pose before it, carried to the values asked for";
    case PoseOrigin::kNextPose:
      return "the pose after it";
    case PoseOrigin::kBeyondEdge:
      return "an equilibrium beyond an edge";
    case PoseOrigin::kPath:
      return "the path of equilibria";
    case PoseOrigin::kEarlierRun:
      return "the same pose of an earlier run";
  }
  return "none";
}

std::string in_words(const PoseTrace& trace) {
  if (trace.route == PoseRoute::kNone) return "-";
  std::string way = name(trace.route);
  if (trace.parts > 0) way = fmt::format("in {}{}", trace.parts, way.substr(2));
  return way + " from " + name(trace.origin);
}

}  // namespace condyle
