#pragma once

/// Wraps with fit = "bone": ellipsoids fitted to the mesh of their body where the shortest strings of
/// their ligaments touch it.
///
/// At each preset pose (preset_flexion.h) the shortest string of each ligament about the smoothed bone
/// (bone_string.h) says where it touches; the vertices of the mesh within 4 mm (or 6, or 8) of these
/// points, facing the way the string presses from, get the ellipsoid of least squares of their
/// distances.

#include <optional>
#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct WrapFitOptions {
  /// Vertices count up to here from where a string touches [mm]; the next is taken where the fit to
  /// what lies within the one before is refused.
  std::vector<double> regions = {4, 6, 8};
  double least_cosine = 0.5;    ///< of their normals and that of the bone there
  double most_rms = 0.6;        ///< a fit beyond is refused [mm]
  double most_semi_axis = 150;  ///< and one with a longer semi-axis [mm]
};

/// Gives the wraps that ask for it their shape, and the ligaments on them the slack lengths that
/// follow. `bones`: the mesh of each body of the scene, cleaned. Throws InputError for a mesh that is
/// not closed, strings that touch nothing, and fits that are refused.
void fit_wraps(Scene& scene,
               const std::vector<TriangleMesh>& bones,
               const WrapFitOptions& options = {});

/// The same with the meshes of those bodies that need one, taken from fitted surfaces where they are
/// there.
void fit_wraps(Scene& scene, const std::vector<FittedSurface>& surfaces);

/// One line for each wrap that was fitted: its size, how well it fits, and by how much strings over it
/// differ from those over the mesh.
[[nodiscard]] std::vector<std::string> describe_wrap_fits(const Scene& scene);

/// The largest part of a cleaned mesh, turned outward; none where it does not enclose a volume.
[[nodiscard]] std::optional<TriangleMesh> solid_bone(const TriangleMesh& bone);

}  // namespace condyle
