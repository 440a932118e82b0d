#pragma once

/// Roughness such as segmentation leaves on a bone: a random field with Gaussian correlation, along
/// the exact normals.

#include <cstdint>

#include "condyle/mesh/triangle_mesh.h"
#include "phantom/phantom_shape.h"

namespace condyle::phantom {

struct Roughness {
  double rms = 0.2;          ///< over the vertices [mm]
  double correlation = 1.5;  ///< length l of the correlation exp(-d²/2l²) [mm]
  std::uint64_t seed = 1;
};

/// Moves every vertex of a mesh that lies on the exact surface. The same seed gives the same field.
void roughen(Bone bone,
             const Roughness& roughness,
             TriangleMesh& mesh,
             const PhantomParameters& knee = kShippedPhantom);

}  // namespace condyle::phantom
