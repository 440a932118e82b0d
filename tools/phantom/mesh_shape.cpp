#include "phantom/mesh_shape.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <utility>

namespace condyle::phantom {

namespace {

using Eigen::Vector3d;
using Cell = std::array<int, 3>;
using Knee = PhantomParameters;

/// Values of the shape at the nodes of a regular grid.
struct Grid {
  Vector3d origin;
  double cell;
  Cell nodes;
  std::vector<double> f;

  [[nodiscard]] std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * nodes[1] + j) * nodes[2] + k;
  }
  [[nodiscard]] Vector3d point(int i, int j, int k) const {
    return origin + cell * Vector3d(i, j, k);
  }
};

/// `before`: how far the grid starts before the box, of a cell.
Grid sample(Bone bone, double cell, double before, const Knee& knee) {
  const Box box = bounds(bone, knee);
  Grid grid{box.low - Vector3d::Constant(before * cell), cell, {}, {}};
  for (int a = 0; a < 3; ++a)
    grid.nodes[a] = static_cast<int>(std::ceil((box.high - grid.origin)[a] / cell)) + 1;
  grid.f.resize(static_cast<std::size_t>(grid.nodes[0]) * grid.nodes[1] * grid.nodes[2]);
  for (int i = 0; i < grid.nodes[0]; ++i)
    for (int j = 0; j < grid.nodes[1]; ++j)
      for (int k = 0; k < grid.nodes[2]; ++k)
        grid.f[grid.at(i, j, k)] = shape(bone, grid.point(i, j, k), knee);
  return grid;
}

/// The mean of the places where the surface crosses the edges of a cell; false where it does not.
bool crossing(const Grid& grid, const Cell& c, Vector3d& mean) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      Cell a = c;
      a[(axis + 1) % 3] += corner & 1;
      a[(axis + 2) % 3] += corner >> 1;
      Cell b = a;
      ++b[axis];
      const double fa = grid.f[grid.at(a[0], a[1], a[2])], fb = grid.f[grid.at(b[0], b[1], b[2])];
      if ((fa < 0) == (fb < 0)) continue;
      sum += grid.point(a[0], a[1], a[2]) + fa / (fa - fb) * grid.cell * Vector3d::Unit(axis);
      ++count;
    }
  if (count == 0) return false;
  mean = sum / count;
  return true;
}

/// One vertex in each cell that the surface crosses; -1 elsewhere in `vertex_of`.
std::vector<int> place_vertices(const Grid& grid, TriangleMesh& mesh) {
  std::vector<int> vertex_of(grid.f.size(), -1);
  for (int i = 0; i + 1 < grid.nodes[0]; ++i)
    for (int j = 0; j + 1 < grid.nodes[1]; ++j)
      for (int k = 0; k + 1 < grid.nodes[2]; ++k) {
        Vector3d p;
        if (!crossing(grid, {i, j, k}, p)) continue;
        vertex_of[grid.at(i, j, k)] = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(p);
      }
  return vertex_of;
}

/// Splits a quadrilateral along its shorter diagonal.
void add_quad(TriangleMesh& mesh, const std::array<int, 4>& q) {
  const auto& v = mesh.vertices;
  if ((v[q[0]] - v[q[2]]).squaredNorm() <= (v[q[1]] - v[q[3]]).squaredNorm()) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  } else {
    mesh.triangles.push_back({q[1], q[2], q[3]});
    mesh.triangles.push_back({q[1], q[3], q[0]});
  }
}

/// A quadrilateral of the four cells round each grid edge that the surface crosses.
void connect(const Grid& grid, const std::vector<int>& vertex_of, TriangleMesh& mesh) {
  for (int i = 1; i + 1 < grid.nodes[0]; ++i)
    for (int j = 1; j + 1 < grid.nodes[1]; ++j)
      for (int k = 1; k + 1 < grid.nodes[2]; ++k)
        for (int axis = 0; axis < 3; ++axis) {
          Cell end = {i, j, k};
          ++end[axis];
          const bool inside = grid.f[grid.at(i, j, k)] < 0;
          if (inside == (grid.f[grid.at(end[0], end[1], end[2])] < 0)) continue;
          const int b = (axis + 1) % 3, c = (axis + 2) % 3;
          std::array<int, 4> quad{};
          const std::array<std::array<int, 2>, 4> round = {{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
          for (int q = 0; q < 4; ++q) {
            Cell cell = {i, j, k};
            cell[b] -= round[q][0];
            cell[c] -= round[q][1];
            quad[inside ? q : 3 - q] = vertex_of[grid.at(cell[0], cell[1], cell[2])];
          }
          add_quad(mesh, quad);
        }
}

/// Dropped onto the surface along the gradient: cheap, and all the mesh needs.
Vector3d onto_surface(Bone bone, Vector3d p, int steps, const Knee& knee) {
  for (int i = 0; i < steps; ++i) {
    const ShapeValue s = shape_derivatives(bone, p, knee);
    const Vector3d step = -s.f / s.g.squaredNorm() * s.g;
    p += step * std::min(1.0, 1.0 / (step.norm() + 1e-300));
    if (step.norm() < 1e-10) break;
  }
  return p;
}

/// Each vertex to the mean of its neighbours, along the surface only.
void relax(Bone bone, TriangleMesh& mesh, const Knee& knee) {
  std::vector<Vector3d> sum(mesh.vertices.size(), Vector3d::Zero());
  std::vector<int> count(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (int a = 0; a < 3; ++a) {  // each edge of a closed mesh is met once per direction
      sum[t[a]] += mesh.vertices[t[(a + 1) % 3]];
      ++count[t[a]];
    }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d p = mesh.vertices[i], n = normal(bone, p, knee);
    const Vector3d shift = sum[i] / count[i] - p;
    mesh.vertices[i] = onto_surface(bone, p + 0.6 * (shift - shift.dot(n) * n), 1, knee);
  }
}

TriangleMesh net(Bone bone, const Grid& grid, const Knee& knee) {
  TriangleMesh mesh;
  const std::vector<int> vertex_of = place_vertices(grid, mesh);
  for (Vector3d& p : mesh.vertices) p = onto_surface(bone, p, 2, knee);
  connect(grid, vertex_of, mesh);
  return mesh;
}

/// Whether each edge is used once in each direction, and the triangles round each vertex are one fan.
bool is_two_manifold(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> next;  // from an edge to the one before it round its start
  std::vector<int> valence(mesh.vertices.size(), 0), some(mesh.vertices.size(), -1);
  for (const auto& t : mesh.triangles)
    for (int a = 0; a < 3; ++a) {
      if (!next.emplace(std::pair(t[a], t[(a + 1) % 3]), t[(a + 2) % 3]).second) return false;
      ++valence[t[a]];
      some[t[a]] = t[(a + 1) % 3];
    }
  for (int v = 0; v < static_cast<int>(valence.size()); ++v) {
    int steps = 0, w = some[v];
    do {
      const auto found = next.find({v, w});
      if (found == next.end()) return false;
      w = found->second;
    } while (++steps < valence[v] && w != some[v]);
    if (steps != valence[v] || w != some[v]) return false;
  }
  return true;
}

}  // namespace

TriangleMesh mesh_bone(Bone bone, double cell, const Knee& knee) {
  TriangleMesh mesh = net(bone, sample(bone, cell, 0, knee), knee);
  constexpr int kGrids = 8;
  for (int i = 1; !is_two_manifold(mesh) && i < kGrids; ++i)
    mesh = net(bone, sample(bone, cell, static_cast<double>(i) / kGrids, knee), knee);
  constexpr int kRelaxations = 6;
  for (int i = 0; i < kRelaxations; ++i) relax(bone, mesh, knee);
  for (Vector3d& p : mesh.vertices) p = onto_surface(bone, p, 12, knee);
  return mesh;
}

}  // namespace condyle::phantom
