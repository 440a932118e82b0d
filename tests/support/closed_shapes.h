#pragma once

/// Closed meshes of exact solids, for tests of what goes on about a bone.

#include "condyle/mesh/clean_mesh.h"
#include "support/mesh_shapes.h"

namespace condyle::test {

/// About the z axis, x = r cos φ, y = r sin φ, along a profile (r, z) from pole to pole, r = 0 there;
/// facing outward.
inline TriangleMesh turned_solid(const std::vector<Eigen::Vector2d>& profile, int around) {
  TriangleMesh mesh =
      grid_sheet(static_cast<int>(profile.size()) - 1, around, [&](double i, double j) {
        const Eigen::Vector2d& at = profile[static_cast<std::size_t>(i)];
        const double angle = 2 * M_PI * j / around;
        return Eigen::Vector3d(at.x() * std::cos(angle), at.x() * std::sin(angle), at.y());
      });
  return clean_mesh(std::move(mesh)).mesh;
}

/// About the origin, semi-axes along x, y, z; about `spacing` [mm] between vertices of the largest.
inline TriangleMesh ellipsoid_solid(const Eigen::Vector3d& semi_axes, double spacing) {
  const int n = static_cast<int>(std::ceil(M_PI * semi_axes.maxCoeff() / spacing));
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= n; ++i) {
    const bool pole = i == 0 || i == n;
    profile.emplace_back(pole ? 0 : std::sin(M_PI * i / n), std::cos(M_PI * i / n));
  }
  TriangleMesh mesh = turned_solid(profile, 2 * n);
  for (Eigen::Vector3d& p : mesh.vertices) p = p.cwiseProduct(semi_axes);
  return mesh;
}

/// About the z axis, with flat ends.
inline TriangleMesh cylinder_solid(double radius, double length, double spacing) {
  const int up = static_cast<int>(std::ceil(length / spacing)),
            out = static_cast<int>(std::ceil(radius / spacing)),
            around = static_cast<int>(std::ceil(2 * M_PI * radius / spacing));
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i < out; ++i) profile.emplace_back(radius * i / out, length / 2);
  for (int i = 0; i <= up; ++i) profile.emplace_back(radius, length * (0.5 - 1.0 * i / up));
  for (int i = out; i-- > 0;) profile.emplace_back(radius * i / out, -length / 2);
  return turned_solid(profile, around);
}

}  // namespace condyle::test
