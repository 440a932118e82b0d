#pragma once

/// A run on disk: HDF5 as shared between programs (format "condyle 1"). All the reader of pictures
/// needs is inside: the scene text, poses, patches, and the bodies' meshes.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/laxity.h"
#include "equilibrium/pose_result.h"
#include "mesh/triangle_mesh.h"
#include "network/simulate.h"
#include "scene/fit_surfaces.h"
#include "scene/scene.h"
#include "surface/patch.h"

namespace condyle {

struct BodyMesh {
  std::string name;   ///< of the body
  TriangleMesh mesh;  ///< body frame [mm]; may be empty
};

struct RunPatch {
  std::string surface;  ///< name of the surface in the scene
  int body = -1;
  PatchData data;
  FitReport report;
};

/// A mesh file that a run was computed from.
struct InputFile {
  std::string file;    ///< as it was opened
  std::string sha256;  ///< of its bytes, in hexadecimal digits
};

struct Run {
  Scene scene;
  SweepResult sweep;
  std::vector<RunPatch> patches;
  std::vector<BodyMesh> bodies;
  std::optional<Comparison> comparison = {};  ///< of `condyle compare`
  std::optional<LaxityResult> laxity = {};    ///< of `condyle laxity`
  std::vector<std::string> start = {};        ///< of a fit: what start_warnings found
  std::optional<Simulation> simulation = {};  ///< of `condyle simulate`; read back without poses
  std::vector<InputFile> inputs = {};         ///< the meshes; none in files of version 0.1.0
  std::string program = {}, created = {};  ///< read back only: who wrote the file, and when (UTC)
};

/// Writes to a temporary file beside `path` and renames it: never a half-written file. Throws
/// InputError when the folder does not exist or the disk is full.
void write_run(const std::filesystem::path& path, const Run& run);

/// Throws InputError for a file that is missing or is not a run.
[[nodiscard]] Run read_run(const std::filesystem::path& path);

}  // namespace condyle
