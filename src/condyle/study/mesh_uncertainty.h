#pragma once

/// How sure the poses of a sweep are, given the meshes: a parametric bootstrap [Efron 1993]. The fitted
/// patches are taken for the truth, and noise of the strength and the correlation that the meshes have
/// beside them (patch_texture.h) is put on them, where the meshes have their vertices; surfaces are
/// fitted to that as they were to the meshes, and the sweep is solved. The same many times, each draw a
/// function of the seed and its number.
///
/// It knows the noise alone that neighbouring vertices share over a few mm. A mesh that is wrong as a
/// whole (too large, a bone cut short) leaves nothing beside its patch.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "condyle/calibration/in_parallel.h"
#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"
#include "condyle/study/patch_texture.h"

namespace condyle {

struct UncertaintyOptions {
  int sweeps = 20;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as there are cores
};

struct RoughSurface {
  std::string surface;
  PatchTexture texture;
};

struct MeshUncertainty {
  int sweeps = 0;
  std::vector<RoughSurface> surfaces;      ///< patches
  std::vector<SensitivityOutput> outputs;  ///< joint coordinates, forces, places of contacts
  /// By outputs and poses, in units used inside: standard deviation over the draws, and how far their
  /// mean is from the sweep itself. NaN where fewer than two draws have that number.
  std::vector<std::vector<double>> sd, shift;
  std::vector<int> converged;  ///< by poses: draws
  int failed_fits = 0;         ///< draws whose meshes could not be fitted
};

/// Joint coordinates, forces of contacts and ligaments, places of contacts (resultant_ground).
[[nodiscard]] std::vector<SensitivityOutput> uncertain_outputs(const Scene& scene);

/// Throws InputError for fewer than two sweeps, and where no surface is fitted to a mesh, one is fitted
/// without smoothing, which follows all noise, or the sweep goes by arc length: its poses have values of
/// their own.
void check_uncertainty(const Scene& scene, const UncertaintyOptions& options);

/// Throws InputError for a patch with too few vertices to tell the noise of its mesh.
void check_noise(const Scene& scene, const std::vector<FittedSurface>& surfaces);

/// `poses`: of the sweep itself. Throws as both do; null where it was stopped.
[[nodiscard]] std::shared_ptr<const MeshUncertainty> mesh_uncertainty(
    const Scene& scene,
    const std::vector<FittedSurface>& surfaces,
    const std::vector<PoseResult>& poses,
    const UncertaintyOptions& options,
    StudyProgress& progress);

}  // namespace condyle
