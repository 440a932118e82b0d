#include "condyle/calibration/bone_triad.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <vector>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// The point of a triangle that is nearest to p [Ericson 2005, 5.1.5].
Vector3d nearest_on_triangle(const Vector3d& a,
                             const Vector3d& b,
                             const Vector3d& c,
                             const Vector3d& p) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
               d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

Vector3d nearest_on(const TriangleMesh& mesh, std::size_t triangle, const Vector3d& p) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto at = [&](int i) -> const Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(i)];
  };
  return nearest_on_triangle(at(a), at(b), at(c), p);
}

/// Twice its area along its normal.
Vector3d area_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vector3d& origin = mesh.vertices[static_cast<std::size_t>(a)];
  return (mesh.vertices[static_cast<std::size_t>(b)] - origin)
      .cross(mesh.vertices[static_cast<std::size_t>(c)] - origin);
}

}  // namespace

std::optional<Vector3d> bone_normal(const TriangleMesh& mesh, const Vector3d& p) {
  constexpr double kWithin = 2;  // [mm]
  Vector3d closest = Vector3d::Zero(), nearest_area = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3d area = area_of(mesh, i);
    if (!(area.norm() > 0)) continue;
    const Vector3d on = nearest_on(mesh, i, p);
    if (const double square = (on - p).squaredNorm(); square < least) {
      least = square;
      closest = on;
      nearest_area = area;
    }
  }
  if (!(nearest_area.norm() > 0)) return std::nullopt;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3d area = area_of(mesh, i);
    if (area.norm() > 0 && (nearest_on(mesh, i, closest) - closest).norm() <= kWithin) sum += area;
  }
  // Of a plate thinner than that both sides are near: the side that is nearest counts.
  const bool one_side = sum.dot(nearest_area) > 0.5 * sum.norm() * nearest_area.norm();
  return (one_side ? sum : nearest_area).normalized();
}

Eigen::Matrix3d triad_about(const Vector3d& n, const Eigen::Matrix3d& axes) {
  const Vector3d along = axes.transpose() * n;
  Eigen::Index axis = 0;
  along.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix3d triad;
  triad.col(0) = (axes.col(axis) - along[axis] * n).normalized();
  triad.col(1) = n.cross(triad.col(0));
  if (axes.col(0).cross(axes.col(1)).dot(axes.col(2)) < 0) triad.col(1) *= -1;
  triad.col(2) = n;
  return triad;
}

}  // namespace condyle
