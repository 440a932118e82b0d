#pragma once

/// The two surfaces of a pair, B's (fixed) and A's (moving), and places on both of them.

#include <algorithm>

#include "condyle/surface/surface.h"

namespace condyle {

struct ContactPlaces {
  Place on_B = {Eigen::Vector3d::Zero()}, on_A = {Eigen::Vector3d::Zero()};

  bool operator==(const ContactPlaces&) const = default;
};

/// Refers to both.
struct SurfacePair {
  const Surface& on_B;
  const Surface& on_A;
};

/// The smaller of the places' distances from the edges of their surfaces [mm].
[[nodiscard]] inline double edge_distance(const SurfacePair& surfaces, const ContactPlaces& at) {
  return std::min(surfaces.on_B.edge_distance(at.on_B), surfaces.on_A.edge_distance(at.on_A));
}

}  // namespace condyle
