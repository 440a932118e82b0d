#pragma once

/// The knee of an OpenSim-JAM model as a scene file.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/exchange/osim_knee.h"
#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct OsimSceneOptions {
  double compression = 100;  ///< load along the tibia in place of muscles and weight [N]; 0: none
  double to = 90;            ///< of the sweep over flexion from 0, by 5 [deg]
};

/// A mesh where the model puts it, to be written beside the scene.
struct OsimMovedMesh {
  std::filesystem::path file;  ///< PLY, mm
  TriangleMesh mesh;
};

struct OsimScene {
  std::string text;                         ///< of the scene (TOML)
  std::vector<OsimMovedMesh> meshes;        ///< that the scene names and that are not there yet
  std::vector<std::filesystem::path> used;  ///< meshes of the model, named or moved
  std::vector<std::string> notes;           ///< what was left out, one line each
};

/// `scene` is where the text will stand; meshes are named relative to its folder. A mesh is looked
/// for beside the model and in Geometry beside it, as OpenSim does; one that stands in its body as
/// it is, in m, cm or mm, is named, any other is moved and scaled. Throws InputError where a
/// contact mesh is not there, is of a format that cannot be read, is scaled to nothing, or would be
/// overwritten.
[[nodiscard]] OsimScene osim_scene(const OsimModel& model,
                                   const OsimKnee& knee,
                                   const std::filesystem::path& file,
                                   const std::filesystem::path& scene,
                                   const OsimSceneOptions& options = {});

}  // namespace condyle
