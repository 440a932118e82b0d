#pragma once

/// Files of phantom knees. What cannot be written is an InputError.

#include <filesystem>

#include "condyle/scene/scene.h"
#include "phantom/phantom_parameters.h"
#include "phantom/phantom_shape.h"
#include "phantom/roughness.h"

namespace condyle::phantom {

struct KneeMeshes {
  double resolution = 0;  ///< grid cell [mm]
  Roughness roughness;
  int split = 0;  ///< times that each triangle is cut into four
};

/// What was written of a bone.
struct WrittenMesh {
  std::size_t vertices = 0, triangles = 0;
};

/// One bone as binary STL.
WrittenMesh write_bone(const std::filesystem::path& file,
                       Bone bone,
                       const KneeMeshes& meshes,
                       const PhantomParameters& knee = kShippedPhantom);

/// P001.toml, P001_femur.stl, P001_tibia.stl ... of `knees` knees of the population `seed` (population.h),
/// their measures as population.csv, and study.toml, which sweeps them all. Each knee's roughness has a
/// seed of its own.
void write_population(const std::filesystem::path& folder,
                      const Scene& shipped,
                      int knees,
                      std::uint64_t seed,
                      const KneeMeshes& meshes);

}  // namespace condyle::phantom
