#include "condyle/mesh_files/polygon_faces.h"

#include <Eigen/Geometry>

#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Corners in the plane of the polygon's vector area, counter-clockwise.
std::vector<Vector2d> flatten(std::span<const Vector3d> corners) {
  Vector3d area = Vector3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i)
    area += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  const double size = area.norm();
  const Vector3d n = size > 0 && std::isfinite(size) ? Vector3d(area / size) : Vector3d::UnitZ();
  const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  std::vector<Vector2d> flat;
  flat.reserve(corners.size());
  for (const Vector3d& p : corners) flat.emplace_back(u.dot(p - corners[0]), v.dot(p - corners[0]));
  return flat;
}

/// Twice the area of a triangle of the plane, positive counter-clockwise.
double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

bool is_convex(const std::vector<Vector2d>& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i)
    if (turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0) return false;
  // A star turns one way all along, but more than once round.
  for (std::size_t i = 2; i < n; ++i)
    if (turn(flat[0], flat[i - 1], flat[i]) < 0) return false;
  return true;
}

bool is_ear(const std::vector<Vector2d>& flat, const std::vector<int>& left, std::size_t at) {
  const std::size_t n = left.size();
  const Vector2d &a = flat[left[(at + n - 1) % n]], &b = flat[left[at]],
                 &c = flat[left[(at + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  for (const int i : left) {
    const Vector2d& p = flat[i];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

bool triangulate(std::span<const Vector3d> corners,
                 std::vector<std::array<int, 3>>& triangles,
                 std::int64_t& work) {
  assert(corners.size() >= 3);
  triangles.clear();
  const int n = static_cast<int>(corners.size());
  const std::vector<Vector2d> flat = flatten(corners);
  if (is_convex(flat)) {
    for (int i = 2; i < n; ++i) triangles.push_back({0, i - 1, i});
    return true;
  }
  if (corners.size() > PolygonFaces::kMostConcave) return false;
  std::vector<int> left(n);
  std::iota(left.begin(), left.end(), 0);
  for (std::size_t at = 0, tried = 0; left.size() > 3;) {
    const std::size_t m = left.size();
    at %= m;
    if ((work -= static_cast<std::int64_t>(m)) < 0) return false;
    // A polygon that crosses itself may have no ear: any corner will do.
    if (tried++ < m && !is_ear(flat, left, at)) {
      ++at;
      continue;
    }
    triangles.push_back({left[(at + m - 1) % m], left[at], left[(at + 1) % m]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    tried = 0;
  }
  triangles.push_back({left[0], left[1], left[2]});
  return true;
}

void PolygonFaces::add(std::span<const int> corners) {
  assert(corners.size() >= 3);
  if (corners.size() == 3) {
    triangles_.push_back({corners[0], corners[1], corners[2]});
  } else {
    polygons_.push_back({count_, triangles_.size(), corners_.size(), corners.size()});
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    triangles_.resize(triangles_.size() + corners.size() - 2);
  }
  ++count_;
}

void PolygonFaces::move_to(TriangleMesh& mesh, const MeshBytes& bytes) {
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> cut;
  std::int64_t work = kMostWork;
  for (const Polygon& polygon : polygons_) {
    const int* corners = corners_.data() + polygon.first_corner;
    points.clear();
    for (std::size_t i = 0; i < polygon.corners; ++i) points.push_back(mesh.vertices[corners[i]]);
    if (!triangulate(points, cut, work))
      bytes.fail(fmt::format("face {} has {} corners and is not convex, expected at most {}{}",
                             polygon.face, polygon.corners, kMostConcave,
                             work < 0 ? ", and fewer such faces that have no ear to cut" : ""));
    for (std::size_t i = 0; i < cut.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        triangles_[polygon.first_triangle + i][k] = corners[cut[i][k]];
  }
  mesh.triangles = std::move(triangles_);
}

}  // namespace condyle
