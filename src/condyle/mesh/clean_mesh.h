#pragma once

/// Mends what segmentation and mesh tools leave behind: coincident vertices, degenerate and
/// duplicate triangles, seams, strays, triangles turned the wrong way round. Everything that is done is
/// counted.

#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/mesh/weld_seams.h"

namespace condyle {

struct CleaningOptions {
  double merge_tolerance =
      1e-6;  ///< vertices closer than this times the diagonal of the bounding box are one
  double stray_fraction =
      0.01;  ///< components below this share of the largest one's area are dropped
};

struct CleaningReport {
  int merged_vertices = 0;
  int degenerate_triangles = 0;  ///< with a repeated vertex or no area
  int duplicate_triangles = 0;   ///< the same three vertices once more
  WeldedSeams seams = {};        ///< whose two sides were not linked
  int unreferenced_vertices = 0;
  int stray_components = 0, stray_triangles = 0;
  int flipped_triangles = 0;  ///< turned to agree with their neighbours, or outward
  int components = 0, closed_components = 0;
  int boundary_edges = 0;      ///< with one triangle
  int non_manifold_edges = 0;  ///< with more than two
};

struct CleanMesh {
  TriangleMesh mesh;
  std::vector<int> component;  ///< of each triangle; 0 has the largest area
  std::vector<bool>
      closed;  ///< each component: encloses a volume, its triangles face outward; a few small holes
               ///< are allowed. An open component is consistent in itself, but may face either way.
  CleaningReport report;
};

/// Triangles belong to one component when they are linked through edges that just two triangles
/// share.
[[nodiscard]] CleanMesh clean_mesh(TriangleMesh mesh, const CleaningOptions& options = {});

/// One line for everything that was mended or dropped, none where the mesh was clean.
[[nodiscard]] std::vector<std::string> describe(const CleaningReport& report);

}  // namespace condyle
