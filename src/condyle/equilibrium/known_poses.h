#pragma once

/// Poses that an earlier sweep of the same scene left, to be taken over by another sweep.

#include <optional>
#include <vector>

#include "condyle/equilibrium/pose_result.h"

namespace condyle {

struct KnownPose {
  PoseResult pose;
  int visit = 0;  ///< how often that sweep had come to this value before: a sweep may turn back
  /// Value of the solved pose before it, where the events in between are known; and these events.
  std::optional<double> from;
  std::vector<Event> events;
  bool from_elsewhere = false;  ///< not found from the pose before it
  bool open = false;  ///< not found, and not looked for yet from a later pose that converged
};

/// The poses of a result, in its order. Its events find their places where the values only rise or
/// only fall; else they are left unknown.
[[nodiscard]] std::vector<KnownPose> known_poses(const SweepResult& result);

/// Two swept values that differ by no more than the rounding of degrees to radians and back.
[[nodiscard]] bool same_value(double a, double b);

/// Finds poses by their value. Refers to the poses, which must stay.
class KnownPoseIndex {
 public:
  explicit KnownPoseIndex(const std::vector<KnownPose>& poses);

  /// The pose of that visit to the value, of several the last; nullptr where there is none.
  [[nodiscard]] const KnownPose* find(double value, int visit) const;

  /// The converged pose with the nearest value; nullptr where none converged.
  [[nodiscard]] const KnownPose* nearest_converged(double value) const;

 private:
  std::vector<const KnownPose*> by_value_;  ///< ascending, equal values in their order
};

}  // namespace condyle
