#pragma once

/// What a run file holds beside forces and places: shapes and resultants of contacts, estimates of
/// contact pressure, stiffness of the joint. A file from before has none of it.

#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Of one contact: `shape`, `resultant_ground` and, where a surface has a modulus, `hertz` (of the
/// point with the greatest force) and `points/hertz` (of all, in slots as in `points`).
void write_contact_estimates(const Hdf5Group& contact,
                             const Hdf5Group& points,
                             const Scene& scene,
                             const std::vector<PoseResult>& poses,
                             std::size_t index);
void read_contact_estimates(const Hdf5Group& contact,
                            const Hdf5Group& points,
                            std::vector<PoseResult>& poses,
                            std::size_t index);

/// `stiffness` and `compliance` [n,6,6], where a pose has them.
void write_joint_stiffness(const Hdf5Group& joint, const std::vector<PoseResult>& poses);
void read_joint_stiffness(const Hdf5Group& joint, std::vector<PoseResult>& poses);

}  // namespace condyle
