#pragma once

/// What all who show a run or pass it on ask of it: which poses have a place, which of them is the
/// nearest to a value, what is swept, where bodies are, and what of the scene is worth seeing.

#include <cstddef>
#include <string>

#include "condyle/results/run_file.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {

/// Does the pose say where the bodies are? True of what converged, and of an equilibrium with a
/// contact beyond the known part of a surface (left patch), where the run holds it.
[[nodiscard]] bool has_place(const PoseResult& pose);
[[nodiscard]] int count_with_place(const SweepResult& sweep);

/// How far a point of contact lies beyond the edge of what is known of its surfaces [mm]; 0 within.
[[nodiscard]] double beyond_edge(const ContactPointResult& point);
/// The farthest of all points, of a closed contact and of all closed contacts of a pose [mm].
[[nodiscard]] double beyond_edge(const ContactResult& contact);
[[nodiscard]] double beyond_edge(const PoseResult& pose);

/// What goes from pose to pose of the run, whatever else its scene could vary.
[[nodiscard]] SweptQuantity swept_quantity(const Run& run);

/// Whether that is the joint coordinate of this index (elements/joint_table.h), whatever its condition is called.
[[nodiscard]] bool is_swept(const Run& run, std::size_t coordinate);

/// Of a comparison the poses of the reference model; null for other runs.
[[nodiscard]] const SweepResult* reference_poses(const Run& run);

/// The pose nearest to a value in the unit of result files, whatever its status; the first of
/// equals. Throws InputError, naming `file`, where the value lies beyond the run by more than 2 %
/// of its range and, of angles and lengths, 0.5 deg or mm.
[[nodiscard]] std::size_t nearest_pose_of(const Run& run, const std::string& file, double value);

/// Whose event it is: the name of a contact, "LIGAMENT on WRAP", or nothing.
[[nodiscard]] std::string event_subject(const Scene& scene, const Event& event);

/// "7.5 us", "87.7 ms", "12.3 s": three digits, in a unit that suits them; `micro` is how
/// microseconds are written.
[[nodiscard]] std::string short_time(double seconds, const std::string& micro);

/// Radius of the tube that stands for a ligament [mm]: many strands are drawn thinner.
[[nodiscard]] double ligament_radius(const Scene& scene);

/// Where in the body's frame a surface without bounds is worth seeing [mm]: at the first contact of
/// the run.
[[nodiscard]] Eigen::Vector3d place_of_interest(const Run& run, int body);

/// Index of the body of that name, or -1.
[[nodiscard]] int body_named(const Scene& scene, const std::string& name);
/// The patch of a surface; null where the run holds none.
[[nodiscard]] const RunPatch* patch_of(const Run& run, const std::string& surface);

/// Pose of a body in the ground frame, where the moving body has the pose X_BA.
[[nodiscard]] RigidTransform body_pose(const Scene& scene, const RigidTransform& X_BA, int body);
/// Corners of a ligament's path between its ends, from the first end to the second, ground frame
/// [mm]; empty for a straight one.
[[nodiscard]] std::vector<Eigen::Vector3d> path_corners(const Scene& scene,
                                                        const PoseResult& pose,
                                                        std::size_t ligament);
/// Index of the tibia's and the femur's body; without [joint] the moving and the fixed body.
[[nodiscard]] int tibia_body(const Scene& scene);
[[nodiscard]] int femur_body(const Scene& scene);

}  // namespace condyle
