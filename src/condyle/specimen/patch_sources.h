#pragma once

/// The meshes that patches of a scene are cut from: collected, read, cleaned, and looked at for whether they are the bones
/// that the scene says.

#include <optional>
#include <string>
#include <vector>

#include "condyle/mesh/clean_mesh.h"
#include "condyle/scene/scene.h"
#include "condyle/specimen/mesh_reader.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

/// A mesh that patches of one body are cut from, with what all of them need to know about it. All
/// is computed about the middle of the mesh, so that it does not matter where the file has its
/// origin; only what fits hand out is in the file's frame again.
struct PatchSource {
  MeshFile file;
  int body = -1;
  std::vector<int> surfaces;                         ///< indices into Scene::surfaces
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the mesh, in the file's frame [mm]
  CleanMesh mesh;                                    ///< about the middle, as the axis
  TriangleMesh shape;                                ///< the same without flat vertices
  std::optional<CondylarAxis> axis;
  bool turned = false;  ///< some of the mesh was turned to face out of the bone
  std::vector<std::string> notes;
};

/// Patches by mesh, so that each file is read once per body. Throws InputError where a patch names no mesh or no part of it.
[[nodiscard]] std::vector<PatchSource> collect_sources(const Scene& scene);

/// Reads the mesh of a source and fills in all but `file`, `body` and `surfaces`. Throws InputError for one that cannot be used.
void load_source(const Scene& scene, const MeshReader& read, PatchSource& source);

/// About the middle of the mesh.
[[nodiscard]] BoneFrame bone_frame(const AnatomicalFrame& frame, const PatchSource& source);

/// Every vertex by d [mm].
void shift(TriangleMesh& mesh, const Eigen::Vector3d& d);

}  // namespace condyle
