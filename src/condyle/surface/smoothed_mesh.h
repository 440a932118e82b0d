#pragma once

/// A closed triangle mesh as a smooth solid, by moving least squares: the vertices around a point,
/// weighted by w = a (exp(-d²/h²) - exp(-9)) with a their area, say how high it lies over the
/// surface. The mean of two answers is taken,
///
///   n·(x - Σ w p/Σ w)         the plane through them [Adamson and Alexa 2003]
///   Σ w n_p·(x - p)/Σ w       their own tangent planes [Shen 2004]
///
/// with n along Σ w n_p: where the surface is curved the first lies h² H/2 too deep and the second as
/// much too high (H: mean of its two curvatures, times two).

#include <memory>

#include "condyle/surface/mesh_distance.h"

namespace condyle {

struct SurfaceHeight {
  double height;           ///< over the surface near by [mm], negative inside
  Eigen::Vector3d normal;  ///< unit, out of the solid
};

class SmoothedMesh {
 public:
  /// `mesh`: closed, facing outward (clean_mesh.h). Keeps a reference. `smoothing`: h [mm]; no less
  /// than the mean edge is taken.
  explicit SmoothedMesh(const TriangleMesh& mesh, double smoothing = 1.5);
  ~SmoothedMesh();

  /// Good near the surface; farther away than h the height over the tangent plane at the closest
  /// point.
  [[nodiscard]] SurfaceHeight height(const Eigen::Vector3d& p) const;
  /// From the mesh itself [mm], negative inside.
  [[nodiscard]] double signed_distance(const Eigen::Vector3d& p) const;

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// Unit, of the vertices.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& normals() const { return normals_; }

 private:
  struct Index;
  const TriangleMesh& mesh_;
  double h_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> areas_;
  MeshDistance distance_;
  std::unique_ptr<Index> index_;
};

}  // namespace condyle
