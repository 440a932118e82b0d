#pragma once

/// Faces of a file as triangles. Faces may come before the vertices they name.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/mesh_files/mesh_bytes.h"

namespace condyle {

/// Collects faces in the order of the file; larger ones are cut once all vertices are known.
class PolygonFaces {
 public:
  static constexpr std::size_t kMostConcave = 1000;  ///< corners of a face that is not convex
  /// Corners that are looked at while all faces of a file that are not convex are cut: seconds.
  static constexpr std::int64_t kMostWork = 1'000'000'000;

  void reserve(std::size_t triangles) { triangles_.reserve(triangles); }
  /// A face of at least three corners.
  void add(std::span<const int> corners);
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Moves the triangles to the mesh, whose vertices every corner must name. Throws InputError in
  /// the name of `bytes` where a face is not convex and has more than kMostConcave corners, or all of
  /// them take more than kMostWork.
  void move_to(TriangleMesh& mesh, const MeshBytes& bytes);

 private:
  struct Polygon {
    std::size_t face, first_triangle, first_corner, corners;
  };
  std::size_t count_ = 0;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Polygon> polygons_;
  std::vector<int> corners_;
};

/// Cuts a polygon into corners - 2 triangles facing its way: a fan where it is convex, else ear by
/// ear in the plane of its vector area. `triangles` holds indices into `corners`.
/// Returns false where it is not convex and larger than PolygonFaces::kMostConcave, or takes more than `work`, from
/// which what it took is taken.
bool triangulate(std::span<const Eigen::Vector3d> corners,
                 std::vector<std::array<int, 3>>& triangles,
                 std::int64_t& work);

}  // namespace condyle
