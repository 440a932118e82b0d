#pragma once

/// Normals, areas and lengths of a triangle mesh.

#include <Eigen/Geometry>

#include <array>
#include <vector>

#include "condyle/mesh/mesh_edges.h"
#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Vector area of one triangle of the mesh [mm²].
[[nodiscard]] Eigen::Vector3d triangle_area(const TriangleMesh& mesh,
                                            const std::array<int, 3>& triangle);

/// The mean of its corners, whichever comes first [mm].
[[nodiscard]] Eigen::Vector3d triangle_middle(const TriangleMesh& mesh,
                                              const std::array<int, 3>& triangle);

/// Vector area of each triangle [mm²]: half the cross product of two edges, along its normal.
[[nodiscard]] std::vector<Eigen::Vector3d> triangle_areas(const TriangleMesh& mesh);

/// Unit normal at each vertex: of the vector areas around it; zero where no triangle has an area.
[[nodiscard]] std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh);

/// A third of the area of the triangles around each vertex [mm²].
[[nodiscard]] std::vector<double> vertex_areas(const TriangleMesh& mesh);

/// About all triangles [mm]: a vertex of none is no part of the bone.
[[nodiscard]] Eigen::AlignedBox3d box_of_triangles(const TriangleMesh& mesh);

/// Mean length of the edges [mm]; 0 for a mesh without triangles.
[[nodiscard]] double mean_edge_length(const TriangleMesh& mesh);

/// The triangles `keep`, with only the vertices they need; `old_index[i]` tells where vertex i was.
struct SubMesh {
  TriangleMesh mesh;
  std::vector<int> old_index;
};
[[nodiscard]] SubMesh sub_mesh(const TriangleMesh& mesh, const std::vector<bool>& keep);

}  // namespace condyle
