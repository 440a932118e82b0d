#pragma once

/// The nearest neighbours of every point of a cloud that is about evenly spaced, by a grid of
/// cubes.

#include <Eigen/Core>

#include <array>
#include <vector>

namespace condyle {

/// For each point the up to eight nearest others within `radius` [mm], nearest first; -1 fills up.
[[nodiscard]] std::vector<std::array<int, 8>> nearest_neighbours(
    const std::vector<Eigen::Vector3d>& points, double radius);

}  // namespace condyle
