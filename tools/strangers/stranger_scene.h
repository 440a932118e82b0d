#pragma once

/// Knees that the program was not tuned to, made from those at hand: moved and turned, with rough
/// bone, under other loads. Scenes are written anew from what was read, meshes in double precision.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "condyle/math/rigid_transform.h"
#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/scene.h"

namespace condyle::strangers {

/// A scene with its meshes in memory, by path.
struct Knee {
  std::string name;
  Scene scene;
  std::map<std::filesystem::path, TriangleMesh> meshes;  ///< [mm], as in the files
};

/// Reads scene and meshes. Throws InputError.
[[nodiscard]] Knee read_knee(const std::string& name, const std::filesystem::path& scene);

/// All dead and follower forces scaled so that the first has this magnitude [N].
void load_with(Knee& knee, double newton);

/// Everything that is fixed to a body in another frame: x becomes X x.
void move_body(Knee& knee, int body, const RigidTransform& X);

/// A random field of the rms [mm] along the normals, correlated over `correlation` mm.
void roughen(Knee& knee, double rms, double correlation, std::uint64_t seed);

/// Writes FOLDER/knee.toml and the meshes beside it; returns the scene's path. Throws InputError
/// for a scene with what this writer does not know.
std::filesystem::path write_knee(const Knee& knee, const std::filesystem::path& folder);

}  // namespace condyle::strangers
