#pragma once

/// A run as OpenSim's tables. Lengths in m, forces in N; .mot in degrees. docs/exchange.md names
/// the columns.

#include <string>
#include <vector>

#include "condyle/exchange/shown_poses.h"

namespace condyle {

/// How the tibia stands in the femur in the coordinates of OpenSim-JAM's knee, with x anterior, y
/// proximal, z to the right in both: p_F = t + R p_T, R = Rz(-flex) Rx(add) Ry(rot). Of a left knee
/// the coordinates of its mirror image.
struct JamCoordinates {
  double flex = 0, add = 0, rot = 0;                      ///< [rad]
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< t [mm]
};
/// Needs scene.joint.
[[nodiscard]] JamCoordinates jam_coordinates(const Scene& scene, const PoseResult& pose);

/// Motion file: the six coordinates. Throws InputError, naming `file`, for a scene without [joint].
[[nodiscard]] std::string mot_of_poses(const Run& run,
                                       const std::vector<ShownPose>& shown,
                                       const std::string& file);

/// Storage file: forces and places of contacts, ligaments.
[[nodiscard]] std::string sto_of_poses(const Run& run, const std::vector<ShownPose>& shown);

}  // namespace condyle
