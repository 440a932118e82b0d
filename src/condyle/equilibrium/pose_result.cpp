#include "condyle/equilibrium/pose_result.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/elements/line_element.h"
#include "condyle/elements/strain.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

LigamentResult told(const LineElement& element, const RigidTransform& X_BA, double* kept) {
  const LineElementState now = line_element_state(element, X_BA, kept);
  return {now.length, strain(element.law, now.length), now.force};
}

/// Of elements of which some have paths; their corners, too.
void tell_with_paths(const PoseFacts& facts, PoseResult& result) {
  const bool known = facts.paths.size() == path_numbers(facts.elements);
  const double* paths = facts.paths.data();
  result.paths.resize(facts.elements.size());
  for (std::size_t i = 0; i < facts.elements.size(); ++i) {
    const LineElement& element = facts.elements[i];
    LigamentPath& path = result.paths[i];
    path.points.clear();
    path.touches.clear();
    if (!element.path) {
      result.ligaments.push_back(told(element, facts.X_BA, nullptr));
      continue;
    }
    std::array<double, kMostPathNumbers> kept;
    if (known) {
      std::copy_n(paths, element.path->numbers(), kept.begin());
      paths += element.path->numbers();
    } else {
      kept = unknown_path();
    }
    result.ligaments.push_back(told(element, facts.X_BA, kept.data()));
    const LineEnds ends = ends_of(element, facts.X_BA);
    element.path->add_touches(ends, facts.X_BA, kept.data(), path.touches);
    element.path->add_points(ends, facts.X_BA, kept.data(), path.touches, path.points);
  }
}

}  // namespace

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
    case EventKind::kTouching:
      return "touching";
    case EventKind::kLifting:
      return "lifting off";
  }
  return "unknown";
}

bool PoseResult::solved() const {
  return (converged() || status == PoseStatus::kLeftPatch) && X_BA.p.allFinite();
}

void clear(PoseResult& result) {
  result.ligaments.clear();
  result.conditions.clear();
  for (ContactResult& contact : result.contacts) clear(contact);
  result.status = PoseStatus::kNotComputed;
  result.reason.clear();
  result.remark.clear();
  result.X_BA.p.setConstant(kNoNumber);
  result.event_seconds = 0;
  result.joint = JointCoordinates();
  result.stability = -1;
  result.lowest_stiffness = kNoNumber;
  result.joint_stiffness.reset();
}

void begin_pose(const PoseFacts& facts, PoseResult& result) {
  result.X_BA = facts.X_BA;
  if (facts.joint != nullptr) result.joint = joint_coordinates(*facts.joint, facts.X_BA);
  const bool straight = std::none_of(facts.elements.begin(), facts.elements.end(),
                                     [](const LineElement& e) { return e.path != nullptr; });
  if (!straight) {
    tell_with_paths(facts, result);
  } else {
    for (const LineElement& element : facts.elements)
      result.ligaments.push_back(told(element, facts.X_BA, nullptr));
  }
  result.contacts.resize(facts.contacts);
}

void add_closed_point(const ContactPointResult& point, ContactResult& contact) {
  contact.closed = true;
  contact.points.push_back(point);
  set_resultant(contact);
}

void set_nearest_point(const ContactPointResult& point, ContactResult& contact) {
  contact.points.push_back(point);
  contact.resultant_ground = point.point_ground;
}

bool has_finite_numbers(const PoseResult& pose) {
  // A sum is finite where its terms are, but for those near the greatest of all numbers.
  const JointCoordinates& q = pose.joint;
  double sum = pose.X_BA.p.sum() + pose.X_BA.R.sum() + q.flexion + q.adduction +
               q.internal_rotation + q.lateral_shift + q.anterior_drawer + q.distraction;
  for (const ContactResult& contact : pose.contacts) {
    sum += contact.force;
    if (contact.closed) sum += contact.resultant_ground.sum();
    for (const ContactPointResult& point : contact.points)
      sum += point.force + point.gap + point.point_ground.sum();
  }
  for (const LigamentResult& ligament : pose.ligaments)
    sum += ligament.length + ligament.strain + ligament.force;
  for (const ConditionResult& condition : pose.conditions)
    sum += condition.value + condition.multiplier;
  return std::isfinite(sum);
}

void to_file_frames(const BodyOrigins& origins, PoseResult& pose) {
  pose.X_BA = origins.out_of_model(pose.X_BA);
  for (ContactResult& contact : pose.contacts) {
    contact.resultant_ground += origins.B;
    for (ContactPointResult& point : contact.points) {
      point.point_ground += origins.B;
      point.point_moving += origins.A;
    }
    for (PressurePoint& point : contact.pressures)
      point.point += point.on_A ? origins.A : origins.B;
    if (contact.layer)
      contact.layer->moment += (pose.X_BA.R * origins.A).cross(contact.layer->force);
  }
  for (LigamentPath& path : pose.paths) {
    for (Eigen::Vector3d& corner : path.points) corner += origins.B;
    for (LineTouch& touch : path.touches) {
      touch.P += touch.on_moving ? origins.A : origins.B;
      touch.Q += touch.on_moving ? origins.A : origins.B;
    }
  }
}

}  // namespace condyle
