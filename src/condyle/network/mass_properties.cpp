#include "condyle/network/mass_properties.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/math/decompositions.h"
#include "condyle/math/rotation.h"
#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

/// Moments of a distribution of mass about the origin: m, ∫ x dm, ∫ x xᵀ dm.
struct Moments {
  double mass = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

/// J = tr(E) I - E from the second moment E, and back: E = tr(J)/2 I - J.
Eigen::Matrix3d inertia_of(const Eigen::Matrix3d& E) {
  return E.trace() * Eigen::Matrix3d::Identity() - E;
}
Eigen::Matrix3d second_moment_of(const Eigen::Matrix3d& J) {
  return J.trace() / 2 * Eigen::Matrix3d::Identity() - J;
}

MassProperties properties_of(const Moments& m, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d center = m.first / m.mass;
  const Eigen::Matrix3d E = m.second - m.mass * center * center.transpose();
  return {m.mass, origin + center, inertia_of((E + E.transpose()) / 2)};
}

int open_edges(const TriangleMesh& mesh) {
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  return static_cast<int>(std::count_if(edges.begin(), edges.end(), [](const MeshEdge& edge) {
    return edge.count != 2 || edge.forward[0] == edge.forward[1];
  }));
}

/// The tetrahedron from the origin to a triangle, its volume signed.
void add_tetrahedron(const Eigen::Vector3d& a,
                     const Eigen::Vector3d& b,
                     const Eigen::Vector3d& c,
                     Moments& m) {
  const double volume = a.dot(b.cross(c)) / 6;
  const Eigen::Vector3d sum = a + b + c;
  m.mass += volume;
  m.first += volume / 4 * sum;
  m.second += volume / 20 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
}

}  // namespace

MassProperties mass_of_solid(const TriangleMesh& mesh, double density, const std::string& what) {
  if (const int open = open_edges(mesh); open > 0 || mesh.triangles.empty()) {
    throw InputError(
        fmt::format("{}: {} edges of the mesh are not shared by two triangles that agree, expected "
                    "a closed mesh for its mass (or mass, center and inertia)",
                    what, open));
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : mesh.vertices)
    origin += p / static_cast<double>(mesh.vertices.size());
  Moments m;
  for (const auto& [a, b, c] : mesh.triangles) {
    add_tetrahedron(mesh.vertices[a] - origin, mesh.vertices[b] - origin, mesh.vertices[c] - origin,
                    m);
  }
  if (!(m.mass > 0))
    throw InputError(what + ": the mesh encloses no volume, expected triangles that face outward");
  m.mass *= density;
  m.first *= density;
  m.second *= density;
  return properties_of(m, origin);
}

MassProperties mass_of_points(const std::vector<PointMass>& points) {
  Moments m;
  for (const PointMass& point : points) {
    m.mass += point.mass;
    m.first += point.mass * point.position;
    m.second += point.mass * point.position * point.position.transpose();
  }
  return properties_of(m, Eigen::Vector3d::Zero());
}

Eigen::Matrix3d inertia_about(const MassProperties& body, const Eigen::Vector3d& point) {
  const Eigen::Matrix3d R = skew(body.center - point);
  return body.inertia + body.mass * R * R.transpose();
}

double polar_inertia_about(const MassProperties& body, const Eigen::Vector3d& point) {
  return inertia_about(body, point).trace() / 2;
}

std::array<PointMass, 6> equimomental_points(const MassProperties& body) {
  const SymmetricEigenvalues principal = symmetric_eigenvalues(second_moment_of(body.inertia));
  std::array<PointMass, 6> points;
  for (int axis = 0; axis < 3; ++axis) {
    const double moment = std::max(0.0, principal.values[axis]);
    const Eigen::Vector3d arm = std::sqrt(3 * moment / body.mass) * principal.vectors.col(axis);
    points[2 * axis] = {body.mass / 6, body.center + arm};
    points[2 * axis + 1] = {body.mass / 6, body.center - arm};
  }
  return points;
}

}  // namespace condyle
