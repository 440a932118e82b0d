#pragma once

/// The meshes that a knee is made of.

#include <optional>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Meshes as their files have them, cleaned, all four in one frame and one unit. Bones may be whole,
/// cut, or sheets of the articular end alone; a fibula may be one with the tibia.
struct KneeMeshes {
  TriangleMesh femur, tibia;
  std::optional<TriangleMesh> femoral_cartilage,
      tibial_cartilage;  ///< sheets or closed slabs; medial and lateral in one mesh
};

}  // namespace condyle
