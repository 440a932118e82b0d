#pragma once

/// Two positions of equilibrium at the same values: told apart, and told of.

#include <string>

#include "condyle/equilibrium/model.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

/// How far two poses are from each other in units of L, rotations counted as L dπ.
[[nodiscard]] double distance(const Model& model, const RigidTransform& a, const RigidTransform& b);

/// Do two poses agree to within 1e-6 L, rotations counted as L dπ?
[[nodiscard]] bool same_pose(const Model& model, const RigidTransform& a, const RigidTransform& b);

/// "a second position of equilibrium exists at this value: from another start the body rests 3.2 mm
/// and 4.1 degrees away"
[[nodiscard]] std::string second_equilibrium(const Model& model,
                                             const RigidTransform& here,
                                             const RigidTransform& there,
                                             const std::string& by);

/// "since the pose before it the body moved 42 mm and 3.1 degrees beyond what is prescribed"; empty
/// for less than half of L (rotations as L dπ): `carried` is the pose before with the prescribed
/// coordinates of `here` (carried_pose.h).
[[nodiscard]] std::string jump(const Model& model,
                               const RigidTransform& carried,
                               const RigidTransform& here);

/// The remark of a pose tells of this jump (as `jump` has it, or nothing) and of no other.
void tell_jump(PoseResult& pose, const std::string& words);

/// Adds a sentence to the remark of a pose, once.
void add_remark(PoseResult& pose, const std::string& remark);

}  // namespace condyle
