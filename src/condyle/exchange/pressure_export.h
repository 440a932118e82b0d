#pragma once

/// Pressures of elastic layers for other programs: each point of both surfaces that is pressed.
///
///     pose,swept,swept_unit,contact,surface,u_mm,v_mm,x_mm,y_mm,z_mm,pressure_N/mm2,depth_mm,area_mm2
///
/// Places in the ground frame; u and v of a patch.

#include <string>
#include <vector>

#include "condyle/exchange/shown_poses.h"

namespace condyle {

/// Does any contact of the run carry by elastic layers?
[[nodiscard]] bool has_layers(const Run& run);

/// A row for each point.
[[nodiscard]] std::string csv_of_pressures(const Run& run, const std::vector<ShownPose>& shown);

/// The points of a pose, with pressure, depth and area; cells are named CONTACT/SURFACE.
[[nodiscard]] std::string pressures_vtp(const Run& run, const PoseResult& pose);

}  // namespace condyle
