#pragma once

/// Small exact meshes for tests.

#include <Eigen/Geometry>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle::test {

/// A sheet over the grid [0, nu] x [0, nv], each cell cut in two; `point` maps (i, j) to space.
/// Faces towards ∂i x ∂j.
inline TriangleMesh grid_sheet(int nu,
                               int nv,
                               const std::function<Eigen::Vector3d(double, double)>& point) {
  TriangleMesh mesh;
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j) mesh.vertices.push_back(point(i, j));
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const int a = i * (nv + 1) + j, b = a + nv + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

/// Height z = height(x, y) over a square of the side, centred at the origin, n x n cells.
inline TriangleMesh height_sheet(double side,
                                 int n,
                                 const std::function<double(double, double)>& height) {
  return grid_sheet(n, n, [&](double i, double j) {
    const double x = side * (i / n - 0.5), y = side * (j / n - 0.5);
    return Eigen::Vector3d(x, y, height(x, y));
  });
}

/// A closed cube of the given side, one corner at `corner`, facing outward: 8 vertices, 12
/// triangles.
inline TriangleMesh cube(double side, const Eigen::Vector3d& corner = Eigen::Vector3d::Zero()) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(corner + side * Eigen::Vector3d(i & 1, (i >> 1) & 1, i >> 2));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline void write_off(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::ofstream off(file);
  off.precision(17);
  off << "OFF\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const Eigen::Vector3d& v : mesh.vertices) off << v.transpose() << '\n';
  for (const auto& [a, b, c] : mesh.triangles) off << "3 " << a << ' ' << b << ' ' << c << '\n';
}

inline double enclosed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  return volume;
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const int offset = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
}

}  // namespace condyle::test
