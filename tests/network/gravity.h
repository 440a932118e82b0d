#pragma once

#include <Eigen/Core>

namespace condyle {

inline const Eigen::Vector3d kGravity(0, -9810, 0);  ///< [mm/s²]

}  // namespace condyle
