#pragma once

/// Roughness such as segmentation leaves on a mesh: vertices moved along their normals by a random
/// field of given strength and correlation, and surfaces fitted anew to what comes out.
///
/// The field is a sum of plane waves, √(2/n) Σ cos(k·x + φ), wave vectors normally distributed with
/// deviation 1/l, so that the correlation over distance d is exp(-d²/2l²). x is taken from the mean of
/// the vertices along the anatomical axes of the bone, or those of the mesh's file where it has none: the
/// field moves, turns and is mirrored with the knee. A wave is a function of the seed, the number of the
/// mesh and its own number; meshes count by the names of their surfaces, in whatever order they stand.

#include <cstdint>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct MeshRoughness {
  double rms = 0;          ///< expected of the field [mm]
  double correlation = 0;  ///< length l [mm], > 0
  std::uint64_t seed = 1;
};

/// Where x is zero, and along what it is told: rows, unit, at right angles.
struct FieldFrame {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// The field at points, by their order [mm]. `mesh`: which of the meshes of a knee.
[[nodiscard]] std::vector<double> roughness_field(const std::vector<Eigen::Vector3d>& points,
                                                  const FieldFrame& frame,
                                                  const MeshRoughness& roughness,
                                                  std::uint64_t mesh = 0);

/// Moves the vertices named (all: none named) along the normals of the mesh.
void roughen(TriangleMesh& mesh,
             const MeshRoughness& roughness,
             std::uint64_t number = 0,
             const std::vector<int>& vertices = {});

/// A mesh that patches of a scene are fitted to, cleaned, with what it takes to move it.
struct FittedMesh {
  MeshFile file;
  TriangleMesh mesh;
  FieldFrame frame;                              ///< from the mean of all vertices
  std::vector<int> moved;                        ///< vertices near the fitted regions
  std::vector<Eigen::Vector3d> places, normals;  ///< of these, before they are moved
};

/// Indices of the patches of a scene, by their names.
[[nodiscard]] std::vector<std::size_t> patches_by_name(const Scene& scene);

/// Each mesh once, by the names of its surfaces; read again only where the surfaces do not hold it.
/// Empty where no surface is a patch.
[[nodiscard]] std::vector<FittedMesh> fitted_meshes(const Scene& scene,
                                                    const std::vector<FittedSurface>& surfaces);

/// The surfaces of a scene fitted to its meshes with roughness on them, by one thread; the regions and
/// the smoothing that the scene leaves open are found anew. Exact surfaces, and the bones that lines
/// are led round, stay. `meshes`: of fitted_meshes. Throws InputError where a mesh can no longer be
/// fitted.
[[nodiscard]] std::vector<FittedSurface> roughened_surfaces(
    const Scene& scene,
    const std::vector<FittedSurface>& surfaces,
    const std::vector<FittedMesh>& meshes,
    const MeshRoughness& roughness);
[[nodiscard]] std::vector<FittedSurface> roughened_surfaces(
    const Scene& scene, const std::vector<FittedSurface>& surfaces, const MeshRoughness& roughness);

}  // namespace condyle
