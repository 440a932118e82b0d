#pragma once

/// The phantom knee on its exact surfaces: the truth for the whole way from a mesh to a pose.

#include <compare>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "condyle/equilibrium/sweep.h"
#include "condyle/mesh/triangle_mesh.h"
#include "condyle/specimen/fit_surfaces.h"
#include "phantom/phantom_shape.h"

namespace condyle::accuracy {

/// Root mean square and greatest of errors.
struct Spread {
  double squares = 0, greatest = 0;
  int count = 0;
  void add(double error);
  [[nodiscard]] double rms() const;
};

/// Of converged poses against the exact ones at the same flexion.
struct PoseErrors {
  Spread translation;                   ///< of the tibia's origin, within the joint [mm]
  Spread rotation;                      ///< [degrees]
  Spread place;                         ///< of the contacts, on the femur [mm]
  Spread force;                         ///< of the contacts [%]
  Spread ligament;                      ///< of each ligament [N]
  int poses = 0, converged = 0;         ///< of `poses`
  std::map<std::string, int> failures;  ///< by status
  void add(const SweepResult& run, const SweepResult& truth);
};

/// Of patches against the exact bone, farther than 4 mm from the edge of what is known.
struct PatchErrors {
  Spread position;   ///< [mm]
  Spread normal;     ///< [degrees]
  Spread curvature;  ///< of the tensor, per root of two principal values [1/mm]
  void add(phantom::Bone bone, const Surface& patch);
};

[[nodiscard]] phantom::Bone bone_of(const Scene& scene, const SurfaceDescription& surface);

/// The shipped knee from 0 to 90 degrees.
[[nodiscard]] Scene phantom_scene(const std::filesystem::path& root, double step_degrees);

[[nodiscard]] std::vector<FittedSurface> exact_surfaces(const Scene& scene);

/// Lengths in mm.
struct Texture {
  double cell, roughness, correlation;
  int seed;
  // NOLINTNEXTLINE(modernize-use-nullptr) made by the compiler (clang-tidy 14)
  auto operator<=>(const Texture&) const = default;
};

/// Meshes of the two bones as files of a folder of their own, which goes when this does.
class MeshFiles {
 public:
  explicit MeshFiles(std::filesystem::path folder);
  ~MeshFiles();
  MeshFiles(const MeshFiles&) = delete;
  MeshFiles& operator=(const MeshFiles&) = delete;
  /// Writes both meshes and names them in the scene.
  void write(const Texture& texture, Scene& scene);

 private:
  const TriangleMesh& mesh(phantom::Bone bone, const Texture& texture);

  std::filesystem::path folder_;
  std::map<std::pair<phantom::Bone, Texture>, TriangleMesh> made_;
};

}  // namespace condyle::accuracy
