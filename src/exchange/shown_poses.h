#pragma once

/// What every exporter asks of a run: its converged poses, when they are shown, where the bodies
/// are, and which way is up.

#include <cstddef>
#include <string>
#include <vector>

#include "results/run_file.h"

namespace condyle {

/// A converged pose at its time.
struct ShownPose {
  std::size_t index = 0;  ///< in the sweep
  double time = 0;        ///< [s], increasing; a simulation's own time
};

inline constexpr double kDegreesPerSecond = 10;

/// The converged poses of a run. Time in a sweep is a convention: 10 deg a second where an angle is
/// swept, else 5 s for all of it, with equal steps for equal changes of the swept value. Throws
/// InputError, naming `file`, where no pose has converged.
[[nodiscard]] std::vector<ShownPose> shown_poses(const Run& run, const std::string& file);

/// Those of the shown poses that are nearest to the values asked for (in the shown unit), each once
/// and in the order of the run. Throws InputError where a value lies beyond the run.
[[nodiscard]] std::vector<ShownPose> shown_poses_at(const Run& run,
                                                    const std::string& file,
                                                    const std::vector<double>& values);

/// Of a sweep over an angle [deg], over a length [mm], over a load's factor [1], or of a motion
/// [s]: the factor from the value inside, and the unit's name.
struct ShownUnit {
  std::string name;
  double per_inside = 1;
};
[[nodiscard]] ShownUnit shown_unit(const Scene& scene);

/// Pose of a body in the ground frame.
[[nodiscard]] RigidTransform body_pose(const Scene& scene, const PoseResult& pose, int body);

/// A ligament's end in the ground frame [mm].
[[nodiscard]] Eigen::Vector3d insertion(const Scene& scene,
                                        const PoseResult& pose,
                                        const Attachment& end);

/// The point of a contact that carries most; of an open contact the nearest one. Null where the
/// pose holds none.
[[nodiscard]] const ContactPointResult* strongest_point(const ContactResult& contact);

/// Force of a contact on the moving body, ground frame [N].
[[nodiscard]] Eigen::Vector3d force_on_moving_body(const ContactResult& contact);

/// Where it acts, ground frame [mm]; of an open contact the nearest point, and without a point the
/// origin.
[[nodiscard]] Eigen::Vector3d force_place(const ContactResult& contact);

/// Takes the ground frame to x to the person's left, y superior, z anterior: a rotation, never a
/// mirror. The anatomical frame of the fixed body says what is what; without [joint] nothing turns.
[[nodiscard]] Eigen::Matrix3d upright(const Scene& scene);

/// Where in the body's frame a surface without bounds is worth seeing: at the body's first contact.
[[nodiscard]] Eigen::Vector3d place_of_interest(const Run& run, int body);

/// Index of the body of that name, or -1.
[[nodiscard]] int body_named(const Scene& scene, const std::string& name);

}  // namespace condyle
