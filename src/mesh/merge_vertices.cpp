#include "mesh/merge_vertices.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace condyle {
namespace {

using Eigen::Vector3d;
using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

std::uint64_t key_of(const Cell& cell) {
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i) {
    key ^= static_cast<std::uint64_t>(cell[i]);
    key *= 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio
    key ^= key >> 29;
  }
  return key;
}

/// Points in a grid of cells much larger than the tolerance, so that nearly every look-up visits
/// one cell.
class PointGrid {
 public:
  PointGrid(double tolerance, std::size_t capacity) : tolerance_(tolerance), cell_(64 * tolerance) {
    first_.reserve(capacity);
    points_.reserve(capacity);
    next_.reserve(capacity);
  }

  /// Index of the point within tolerance of p, which is added where there is none.
  int find_or_add(const Vector3d& p) {
    const Cell low = cell_of(p.array() - tolerance_), high = cell_of(p.array() + tolerance_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          if (const int found = find_in(Cell(x, y, z), p); found >= 0) return found;
    const int index = static_cast<int>(points_.size());
    const auto [slot, fresh] = first_.try_emplace(key_of(cell_of(p)), index);
    next_.push_back(fresh ? -1 : slot->second);
    slot->second = index;
    points_.push_back(p);
    return index;
  }

  [[nodiscard]] std::vector<Vector3d> take_points() { return std::move(points_); }

 private:
  [[nodiscard]] Cell cell_of(const Vector3d& p) const {
    return (p / cell_).array().floor().cast<std::int64_t>();
  }
  [[nodiscard]] int find_in(const Cell& cell, const Vector3d& p) const {
    const auto slot = first_.find(key_of(cell));
    for (int i = slot == first_.end() ? -1 : slot->second; i >= 0; i = next_[i])
      if ((points_[i] - p).squaredNorm() <= tolerance_ * tolerance_) return i;
    return -1;
  }

  double tolerance_, cell_;
  std::unordered_map<std::uint64_t, int> first_;
  std::vector<int> next_;
  std::vector<Vector3d> points_;
};

}  // namespace

int merge_vertices(TriangleMesh& mesh, double tolerance) {
  const std::size_t before = mesh.vertices.size();
  if (before == 0 || !(tolerance > 0)) return 0;
  PointGrid grid(tolerance, before);
  std::vector<int> new_index;
  new_index.reserve(before);
  for (const Vector3d& p : mesh.vertices) new_index.push_back(grid.find_or_add(p));
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = new_index[v];
  mesh.vertices = grid.take_points();
  return static_cast<int>(before - mesh.vertices.size());
}

int drop_unreferenced_vertices(TriangleMesh& mesh) {
  std::vector<int> new_index(mesh.vertices.size(), -1);
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) new_index[v] = 0;
  std::vector<Vector3d> kept;
  kept.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (new_index[v] < 0) continue;
    new_index[v] = static_cast<int>(kept.size());
    kept.push_back(mesh.vertices[v]);
  }
  const int dropped = static_cast<int>(mesh.vertices.size() - kept.size());
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = new_index[v];
  mesh.vertices = std::move(kept);
  return dropped;
}

}  // namespace condyle
