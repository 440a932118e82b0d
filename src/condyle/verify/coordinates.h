#pragma once

/// Joint coordinates and prescribed coordinates of a pose from the definition of Grood and Suntay,
/// and how they change with the pose.

#include <Eigen/Core>

#include <array>

#include "condyle/math/rigid_transform.h"
#include "condyle/scene/scene.h"

namespace condyle::verification {

/// exp([θ]x), about a point of the ground frame: the pose after the body turned.
[[nodiscard]] Eigen::Matrix3d turn(const Eigen::Vector3d& theta);
[[nodiscard]] RigidTransform moved(const RigidTransform& X_BA,
                                   const Eigen::Vector3d& da,
                                   const Eigen::Vector3d& theta,
                                   const Eigen::Vector3d& about);

/// Flexion, adduction, internal rotation [rad], lateral shift, anterior drawer, distraction [mm];
/// needs scene.joint.
[[nodiscard]] std::array<double, 6> grood_suntay(const Scene& scene, const RigidTransform& X_BA);

/// The start pose of the moving body.
[[nodiscard]] RigidTransform start_of(const Scene& scene);

/// An end of a line in the ground frame [mm].
[[nodiscard]] Eigen::Vector3d in_ground(const Scene& scene,
                                        const Attachment& end,
                                        const RigidTransform& X_BA);

/// The end of a distance that is prescribed which goes with the moving body, in the ground frame [mm].
[[nodiscard]] Eigen::Vector3d end_on_moving(const Scene& scene,
                                            const ConditionDescription& distance,
                                            const RigidTransform& X_BA);

/// What a condition prescribes [rad] or [mm].
[[nodiscard]] double coordinate(const Scene& scene,
                                const ConditionDescription& condition,
                                const RigidTransform& X_BA);

/// a - b, angles within half a turn.
[[nodiscard]] double difference(const ConditionDescription& condition, double a, double b);

/// Of a coordinate against translations of the body (first three) and rotations about the point
/// `about` of the ground frame; exact. Angles have none where their first and last axes are parallel.
[[nodiscard]] Eigen::Matrix<double, 6, 1> gradient(const Scene& scene,
                                                   const ConditionDescription& condition,
                                                   const RigidTransform& X_BA,
                                                   const Eigen::Vector3d& about);

}  // namespace condyle::verification
