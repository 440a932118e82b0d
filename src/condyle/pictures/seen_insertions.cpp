#include "condyle/pictures/seen_insertions.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Height of the triangle a b c over the place (x, y), or far below where it does not cover that
/// place.
double height_at(double x, double y, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  constexpr double kNone = -1e9;
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
  if (area == 0) return kNone;
  const double wb = ((x - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (y - a.y())) / area;
  const double wc = ((b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y())) / area;
  if (wb < 0 || wc < 0 || wb + wc > 1) return kNone;
  return a.z() + wb * (b.z() - a.z()) + wc * (c.z() - a.z());
}

struct Insertion {
  std::size_t ligament;
  Vector3d at;          // right, up the page, towards the viewer
  double cover = -1e9;  // greatest height above its place
};

}  // namespace

std::vector<bool> seen_insertions(const Scene& scene,
                                  const std::vector<BodyShape>& shapes,
                                  int body,
                                  const Eigen::Matrix3d& R_VB,
                                  double depth) {
  std::vector<Insertion> insertions;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    for (const Attachment& end : scene.ligaments[i].ends) {
      if (end.body == body) insertions.push_back({i, R_VB * end.at});
    }
  }
  for (const BodyShape& shape : shapes) {
    if (shape.body != body) continue;
    std::vector<Vector3d> p;
    for (const ShadedVertex& vertex : shape.mesh.vertices)
      p.push_back(R_VB * vertex.position.cast<double>());
    for (const auto& [a, b, c] : shape.mesh.triangles) {
      for (Insertion& insertion : insertions) {
        insertion.cover = std::max(insertion.cover,
                                   height_at(insertion.at.x(), insertion.at.y(), p[a], p[b], p[c]));
      }
    }
  }
  std::vector<bool> seen(scene.ligaments.size(), false);
  for (const Insertion& insertion : insertions) {
    if (insertion.cover < insertion.at.z() + depth) seen[insertion.ligament] = true;
  }
  return seen;
}

}  // namespace condyle
