#pragma once

/// What every exporter asks of a run: its poses, when they are shown, where the bodies
/// are, and which way is up.

#include <cstddef>
#include <string>
#include <vector>

#include "condyle/results/run_view.h"

namespace condyle {

/// A pose that has a place (results/run_view.h) at its time.
struct ShownPose {
  std::size_t index = 0;  ///< in the sweep
  double time = 0;        ///< [s], increasing; a simulation's own time
};

inline constexpr double kDegreesPerSecond = 10;

/// The poses of a run that have a place. Time in a sweep is a convention: 10 deg a second where an
/// angle is swept, else 5 s for all of it, with equal steps for equal changes of the swept value.
/// Throws InputError, naming `file`, where no pose has one.
[[nodiscard]] std::vector<ShownPose> shown_poses(const Run& run, const std::string& file);

/// The poses nearest to the values asked for, each once and in the order of the run. One without a
/// place is left out; throws InputError where that leaves none.
[[nodiscard]] std::vector<ShownPose> shown_poses_at(const Run& run,
                                                    const std::string& file,
                                                    const std::vector<double>& values);

/// Without those that did not converge, for files that cannot mark them; throws InputError where
/// that leaves none.
[[nodiscard]] std::vector<ShownPose> converged_only(const Run& run,
                                                    const std::string& file,
                                                    const std::vector<ShownPose>& shown);

/// A ligament's end in the ground frame [mm].
[[nodiscard]] Eigen::Vector3d insertion(const Scene& scene,
                                        const PoseResult& pose,
                                        const Attachment& end);

/// Force of a contact on the moving body, ground frame [N].
[[nodiscard]] Eigen::Vector3d force_on_moving_body(const ContactResult& contact);

/// Where it acts, ground frame [mm]; of an open contact the nearest point, and without a point the
/// origin.
[[nodiscard]] Eigen::Vector3d force_place(const ContactResult& contact);

/// Takes the ground frame to x to the person's left, y superior, z anterior: a rotation, never a
/// mirror. The anatomical frame of the fixed body says what is what; without [joint] nothing turns.
[[nodiscard]] Eigen::Matrix3d upright(const Scene& scene);

}  // namespace condyle
