#include "condyle/anatomy/plateau.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/math/decompositions.h"
#include "condyle/math/disjoint_sets.h"
#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastCosine = 0.6, kFullCosine = 0.8;  // of a face's normal and the plateau's
constexpr double kBelow = 6, kAbove = 10;  // what belongs to the plateau, from its plane [mm]
constexpr double kResidualScale =
    2;  // beyond it a face loses its say in the plane: eminence and rims [mm]
constexpr double kLeastPart = 0.3;  // of the largest linked part: less is no half of a plateau

struct Face {
  Vector3d p;
  double weight;  // area seen along the normal [mm²]
};

/// 0 below `none`, 1 above `full`.
double ramp(double x, double none, double full) {
  return std::clamp((x - none) / (full - none), 0.0, 1.0);
}

/// Areas of the vertices seen along the normal, of those that belong to the plateau, 0 of others [mm²].
std::vector<double> areas_along(const TriangleMesh& mesh,
                                const std::vector<Vector3d>& normals,
                                const std::vector<double>& areas,
                                const Plateau& plateau,
                                double below,
                                double reach) {
  std::vector<double> seen(areas.size(), 0);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Vector3d q = mesh.vertices[i] - plateau.middle;
    const double height = plateau.normal.dot(q), cosine = plateau.normal.dot(normals[i]);
    if (q.norm() < reach && height < kAbove)
      seen[i] = areas[i] * cosine * ramp(cosine, kLeastCosine, kFullCosine) *
                ramp(height, -below, -below / 2);
  }
  return seen;
}

/// Vertices of the large linked parts: no head of a fibula, no islands.
std::vector<Face> large_parts(const TriangleMesh& mesh, const std::vector<double>& seen) {
  DisjointSets linked(seen.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    if (seen[a] == 0 || seen[b] == 0 || seen[c] == 0) continue;
    linked.join(a, b);
    linked.join(b, c);
  }
  if (seen.empty()) return {};
  std::vector<double> part(seen.size(), 0);
  for (std::size_t i = 0; i < seen.size(); ++i) part[linked.root(static_cast<int>(i))] += seen[i];
  const double least = kLeastPart * *std::max_element(part.begin(), part.end());
  std::vector<Face> faces;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i] > 0 && part[linked.root(static_cast<int>(i))] >= least)
      faces.push_back({mesh.vertices[i], seen[i]});
  return faces;
}

/// Heights over the plane, z = a + b·(u, v), by reweighted least squares.
void fit_plane(Plateau& plateau, const std::vector<Face>& faces) {
  const Vector3d u = plateau.across, v = plateau.normal.cross(u);
  Vector3d x = Vector3d::Zero();
  for (int iteration = 0; iteration < 8; ++iteration) {
    Eigen::Matrix3d A = 1e-9 * Eigen::Matrix3d::Identity();
    Vector3d b = Vector3d::Zero();
    for (const Face& f : faces) {
      const Vector3d q = f.p - plateau.middle;
      const Vector3d row(1, u.dot(q), v.dot(q));
      const double z = plateau.normal.dot(q), r = (z - row.dot(x)) / kResidualScale;
      const double weight = f.weight / (1 + r * r);
      A += weight * row * row.transpose();
      b += weight * z * row;
    }
    x = symmetric_solution(A, b);
  }
  plateau.middle += x[0] * plateau.normal;
  plateau.normal = (plateau.normal - x[1] * u - x[2] * v).normalized();
}

/// Middle and longest extent of what belongs to the plane.
void fit_outline(Plateau& plateau, const std::vector<Face>& faces) {
  plateau.across =
      (plateau.across - plateau.normal * plateau.normal.dot(plateau.across)).normalized();
  const Vector3d u = plateau.across, v = plateau.normal.cross(u);
  double area = 0;
  Vector2d first = Vector2d::Zero();
  Matrix2d second = Matrix2d::Zero();
  for (const Face& f : faces) {
    const Vector2d q(u.dot(f.p - plateau.middle), v.dot(f.p - plateau.middle));
    area += f.weight;
    first += f.weight * q;
    second += f.weight * q * q.transpose();
  }
  first /= area;
  const Vector2d longest =
      plane_eigenvalues(second / area - first * first.transpose()).vectors.col(1);
  plateau.area = area;
  plateau.middle += u * first.x() + v * first.y();
  plateau.across = (longest.x() * u + longest.y() * v) * (longest.x() < 0 ? -1 : 1);
}

/// Middles of the two halves, the middle between them, and extents.
void measure(Plateau& plateau, const std::vector<Face>& faces) {
  Vector3d sum[2] = {Vector3d::Zero(), Vector3d::Zero()};
  double area[2] = {1e-300, 1e-300};
  const Vector3d forward = plateau.normal.cross(plateau.across);
  Eigen::AlignedBox2d box;
  for (const Face& f : faces) {
    const Vector3d q = f.p - plateau.middle;
    const int half = plateau.across.dot(q) > 0;
    sum[half] += f.weight * q;
    area[half] += f.weight;
    box.extend(Vector2d(plateau.across.dot(q), forward.dot(q)));
  }
  const Vector3d a = sum[0] / area[0], b = sum[1] / area[1];
  plateau.halves = (b - a).normalized();
  const Vector3d between = (a + b) / 2;
  plateau.middle += between - plateau.normal * plateau.normal.dot(between);
  plateau.width = box.sizes().x();
  double weight = 1e-300;
  for (const Face& f : faces) {
    const Vector3d q = f.p - plateau.middle;
    if (std::abs(plateau.across.dot(q)) > 0.15 * plateau.width) continue;
    weight += f.weight;
    plateau.eminence += f.weight * plateau.normal.dot(q);
  }
  plateau.eminence /= weight;
  plateau.depth = box.sizes().y();
}

}  // namespace

Plateau fit_plateau(const TriangleMesh& mesh,
                    const std::vector<Vector3d>& normals,
                    const Vector3d& at,
                    const Vector3d& proximal,
                    const Vector3d& across) {
  constexpr double kReach = 65;  // from the middle to the farthest corner [mm]
  const std::vector<double> areas = vertex_areas(mesh);
  Plateau plateau{.middle = at, .normal = proximal, .across = across, .halves = across};
  std::vector<Face> faces;
  for (int iteration = 0; iteration < 12; ++iteration) {
    faces = large_parts(mesh, areas_along(mesh, normals, areas, plateau,
                                          iteration < 3 ? 2 * kBelow : kBelow, kReach));
    if (faces.size() < 40) throw InputError("no tibial plateau faces the femur");
    fit_plane(plateau, faces);
    fit_outline(plateau, faces);
  }
  measure(plateau, faces);
  return plateau;
}

}  // namespace condyle
