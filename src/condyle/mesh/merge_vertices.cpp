#include "condyle/mesh/merge_vertices.h"

#include <Eigen/Geometry>

#include <bit>
#include <cmath>
#include <cstdint>

namespace condyle {
namespace {

using Eigen::Vector3d;
using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

/// Points in a grid of cells of 16 tolerances: two look-ups of three visit one cell, and of points
/// farther apart than the tolerance a few thousand fit into it at most, however crowded a mesh is.
/// Cells are hashed to lists of the points in them; the distance sorts out what shares a list by
/// chance.
class PointGrid {
 public:
  /// Over those of `points` that are added; what is added must stay as it is.
  PointGrid(const std::vector<Vector3d>& points, const Vector3d& origin, double tolerance)
      : points_(points),
        origin_(origin),
        tolerance_(tolerance),
        per_cell_(1 / (16 * tolerance)),
        first_(std::bit_ceil(points.size()), -1),
        next_(points.size()) {}

  /// Index of a point within the tolerance of p; -1 where there is none.
  [[nodiscard]] int find(const Vector3d& p) const {
    const Cell low = cell_of(p.array() - tolerance_), high = cell_of(p.array() + tolerance_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          if (const int found = find_in(Cell(x, y, z), p); found >= 0) return found;
    return -1;
  }
  void add(int index) {
    int& first = first_[list_of(cell_of(points_[index]))];
    next_[index] = first;
    first = index;
  }

 private:
  [[nodiscard]] Cell cell_of(const Vector3d& p) const {
    constexpr double kFarthest = 0x1p62;  // what lies beyond shares a cell
    const Eigen::Array3d cells = ((p - origin_) * per_cell_).array().floor();
    return cells.max(-kFarthest).min(kFarthest).cast<std::int64_t>();
  }
  [[nodiscard]] std::size_t list_of(const Cell& cell) const {
    std::uint64_t key = 0;
    for (int i = 0; i < 3; ++i) {
      key ^= static_cast<std::uint64_t>(cell[i]);
      key *= 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio
      key ^= key >> 29;
    }
    return key & (first_.size() - 1);
  }
  [[nodiscard]] int find_in(const Cell& cell, const Vector3d& p) const {
    int i = first_[list_of(cell)];
    while (i >= 0 && !((points_[i] - p).squaredNorm() <= tolerance_ * tolerance_)) i = next_[i];
    return i;
  }

  const std::vector<Vector3d>& points_;
  Vector3d origin_;
  double tolerance_, per_cell_;
  std::vector<int> first_;  ///< of each list; -1: empty. Its size is a power of two
  std::vector<int> next_;   ///< in the list of a point
};

}  // namespace

int merge_vertices(TriangleMesh& mesh, double tolerance) {
  std::vector<Vector3d>& vertices = mesh.vertices;
  const std::size_t before = vertices.size();
  if (before == 0 || !(tolerance > 0)) return 0;
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : vertices)
    if (p.allFinite()) box.extend(p);
  PointGrid grid(vertices, box.min(), tolerance);
  std::vector<int> new_index(before);
  std::size_t kept = 0;
  for (std::size_t v = 0; v < before; ++v) {
    const bool is_finite = vertices[v].allFinite();
    new_index[v] = is_finite ? grid.find(vertices[v]) : -1;
    if (new_index[v] >= 0) continue;
    new_index[v] = static_cast<int>(kept);
    vertices[kept] = vertices[v];
    if (is_finite) grid.add(new_index[v]);
    ++kept;
  }
  if (kept == before) return 0;
  vertices.resize(kept);
  vertices.shrink_to_fit();
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = new_index[v];
  return static_cast<int>(before - kept);
}

int drop_unreferenced_vertices(TriangleMesh& mesh) {
  std::vector<int> new_index(mesh.vertices.size(), -1);
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) new_index[v] = 0;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] < 0) continue;
    new_index[v] = static_cast<int>(kept);
    mesh.vertices[kept++] = mesh.vertices[v];
  }
  const int dropped = static_cast<int>(mesh.vertices.size() - kept);
  if (dropped == 0) return 0;
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = new_index[v];
  mesh.vertices.resize(kept);
  mesh.vertices.shrink_to_fit();
  return dropped;
}

}  // namespace condyle
