#pragma once

/// What a mesh leaves beside the patch that was fitted to it: its vertices as heights over the patch,
/// and the strength and correlation of the texture that these heights are of.
///
/// A fit of smoothing length ℓ follows H(k) = 1/(1 + (ℓk)⁶) of a wave, so of a texture with correlation
/// σ² exp(-d²/2l²) it leaves heights of covariance
///     C(d) = σ² ∫ l² exp(-k²l²/2) (1 - H)² J0(kd) k dk.
/// σ and l are those for which it comes nearest to the covariance of the heights over the middle of the
/// patch, over lags up to 5 mm: more than 4 mm from the edge of what is known, or half as far from it as
/// any where a patch is narrower than 16 mm.

#include <cstddef>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// A vertex of a mesh beside a patch. A patch that was moved out of the bone is meant where it was
/// fitted.
struct VertexOverPatch {
  int vertex = 0;
  Eigen::Vector3d closest;  ///< closest point of the patch [mm]
  Eigen::Vector3d normal;
  double height = 0;         ///< over the patch, out of the bone [mm]
  double edge_distance = 0;  ///< of that point from the edge of what is known [mm]
};

/// Those of `candidates` that the patch was fitted to: over its known part or within 2 mm of that, less
/// than 2 mm off, and facing as the patch does.
[[nodiscard]] std::vector<VertexOverPatch> vertices_over_patch(const TriangleMesh& mesh,
                                                               const std::vector<int>& candidates,
                                                               const Surface& patch,
                                                               double offset);

struct PatchTexture {
  double rms = 0, correlation = 0;  ///< σ, l [mm]
  double left = 0;                  ///< rms of the heights that the fit left [mm]
};

/// Fewer vertices over the middle of a patch tell no texture.
inline constexpr std::size_t kFewestOfTexture = 50;
[[nodiscard]] std::size_t vertices_that_tell(const std::vector<VertexOverPatch>& vertices);

/// The longest correlation that is looked for, 5 mm, comes nearest: what is left is the shape of the
/// bone that the smoothing flattened, as well, and the strength is an upper bound.
[[nodiscard]] bool is_broad(const PatchTexture& texture);

/// `surface`: how the patch was asked for; `report`: its smoothing length. NaN where too few tell.
[[nodiscard]] PatchTexture texture_beside(const std::vector<VertexOverPatch>& vertices,
                                          const PatchDescription& surface,
                                          const FitReport& report);

}  // namespace condyle
