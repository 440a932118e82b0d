#pragma once

/// What of a knee a picture must hold: the joint, not whole bones.

#include <vector>

#include "condyle/pictures/knee_shapes.h"

namespace condyle {

/// Points of each body in its own frame [mm], by which a camera is set: articular surfaces, points
/// of contact over the run, the bone around them, and the insertions that lie near. Near is within
/// three times the radius of what touches about its middle, and bone counts within 1.15 times; of a
/// body without surfaces the insertions say what the joint is. Far ends of shafts and of muscles
/// are left out.
[[nodiscard]] std::vector<std::vector<Eigen::Vector3d>> joint_points(
    const Run& run, const std::vector<BodyShape>& shapes);

/// Of the greatest body's points about their middle [mm]: how large what is shown is.
[[nodiscard]] double joint_radius(const std::vector<std::vector<Eigen::Vector3d>>& joints);

}  // namespace condyle
