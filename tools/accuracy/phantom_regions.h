#pragma once

/// The four articular regions of meshes of the phantom, as the program finds them.

#include <string>
#include <vector>

#include "condyle/surface/articular_region.h"
#include "phantom/phantom_shape.h"

namespace condyle::accuracy {

struct PhantomRegion {
  std::string name;
  phantom::Bone bone;
  ArticularRegion region;
};

/// Medial and lateral condyle, medial and lateral plateau.
[[nodiscard]] std::vector<PhantomRegion> phantom_regions(const TriangleMesh& femur,
                                                         const TriangleMesh& tibia);

}  // namespace condyle::accuracy
