#include "condyle/mesh/drop_flat_vertices.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

namespace condyle {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

constexpr int kGone = -1;       // first index of a triangle that is no more
constexpr double kThin = 0.02;  // least height of a triangle over its longest side

bool holds(const Triangle& t, int vertex) {
  return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Twice the area vector.
Vector3d area_vector(const TriangleMesh& mesh, const Triangle& t) {
  const Vector3d& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

double longest_side(const TriangleMesh& mesh, const Triangle& t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
  return longest;
}

/// A mesh whose vertices can be pulled onto one another.
class Collapsible {
 public:
  Collapsible(TriangleMesh mesh, const FlatVertexOptions& options)
      : mesh_(std::move(mesh)), options_(options), around_(mesh_.vertices.size()) {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const int v : mesh_.triangles[t]) around_[v].push_back(static_cast<int>(t));
  }

  /// Until none is left that can go, those first that are pulled least far: how a file numbers vertices and triangles
  /// decides only where these distances are equal.
  void run() {
    for (bool any = true; any;) {
      any = false;
      for (const auto& [ignored, neither, v] : candidates()) any = drop(v) || any;
    }
  }

  [[nodiscard]] TriangleMesh rest() && {
    std::vector<int> now(mesh_.vertices.size(), kGone);
    TriangleMesh rest;
    for (std::size_t v = 0; v < now.size(); ++v)
      if (!around_[v].empty()) {
        now[v] = static_cast<int>(rest.vertices.size());
        rest.vertices.push_back(mesh_.vertices[v]);
      }
    for (const auto& [a, b, c] : mesh_.triangles)
      if (a != kGone) rest.triangles.push_back({now[a], now[b], now[c]});
    return rest;
  }

 private:
  /// Neighbours of v, with the number of triangles that each shares with it.
  void find_neighbours(int v, std::vector<std::pair<int, int>>& neighbours) const {
    neighbours.clear();
    for (const int t : around_[v])
      for (const int n : mesh_.triangles[t]) {
        if (n == v) continue;
        const auto known = std::find_if(neighbours.begin(), neighbours.end(),
                                        [n](const auto& one) { return one.first == n; });
        if (known == neighbours.end())
          neighbours.emplace_back(n, 1);
        else
          ++known->second;
      }
  }

  /// Distances in steps of a nanometre: of equal ones rounding shall not decide.
  [[nodiscard]] std::int64_t distance(int v, int onto) const {
    return std::llround((mesh_.vertices[v] - mesh_.vertices[onto]).norm() * 1e6);
  }

  /// The nearest neighbour onto which v can be pulled; kGone where there is none.
  [[nodiscard]] int target_of(int v) {
    find_neighbours(v, neighbours_);
    const auto edges = std::count_if(neighbours_.begin(), neighbours_.end(),
                                     [](const auto& one) { return one.second != 2; });
    // A closed fan, or one with two ends on the boundary of the mesh.
    if (edges != 0 && edges != 2) return kGone;
    std::pair<std::int64_t, int> nearest{std::numeric_limits<std::int64_t>::max(), kGone};
    for (const auto& [onto, shared] : neighbours_) {
      const std::pair<std::int64_t, int> here{distance(v, onto), onto};
      if (!(here < nearest)) continue;
      if (edges == 2 && (shared != 1 || !on_straight_boundary(v))) continue;
      if (keeps_shape(v, onto) && keeps_links(onto, shared)) nearest = here;
    }
    return nearest.second;
  }

  /// Vertices that can go, by how far they would be pulled, and of two that would be pulled onto each other first the
  /// one whose neighbours are nearer.
  [[nodiscard]] std::vector<std::tuple<std::int64_t, std::int64_t, int>> candidates() {
    std::vector<std::tuple<std::int64_t, std::int64_t, int>> found;
    for (int v = 0; v < static_cast<int>(around_.size()); ++v) {
      if (around_[v].empty()) continue;
      const int onto = target_of(v);
      if (onto == kGone) continue;
      std::int64_t about = 0;
      for (const auto& [neighbour, ignored] : neighbours_) about += distance(v, neighbour);
      found.emplace_back(distance(v, onto), about, v);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  bool drop(int v) {
    const int onto = around_[v].empty() ? kGone : target_of(v);
    if (onto == kGone) return false;
    pull(v, onto);
    return true;
  }

  [[nodiscard]] bool on_straight_boundary(int v) const {
    const auto is_end = [](const auto& one) { return one.second == 1; };
    const auto first = std::find_if(neighbours_.begin(), neighbours_.end(), is_end);
    const auto second = std::find_if(first + 1, neighbours_.end(), is_end);
    if (second == neighbours_.end()) return false;
    const Vector3d along = mesh_.vertices[second->first] - mesh_.vertices[first->first];
    const double off = along.cross(mesh_.vertices[v] - mesh_.vertices[first->first]).norm();
    return off <= options_.tolerance * along.norm();
  }

  /// Would v lie on every triangle that is new, and none be thin, long or turned over?
  [[nodiscard]] bool keeps_shape(int v, int onto) const {
    for (const int i : around_[v]) {
      const Triangle& before = mesh_.triangles[i];
      if (holds(before, onto)) continue;
      Triangle after = before;
      std::replace(after.begin(), after.end(), v, onto);
      const Vector3d area = area_vector(mesh_, after);
      const double size = area.norm(), off = area.dot(mesh_.vertices[v] - mesh_.vertices[onto]);
      if (!(std::abs(off) <= options_.tolerance * size)) return false;
      const double longest = longest_side(mesh_, after);
      if (longest > options_.longest_edge || size < kThin * longest * longest) return false;
      if (area.dot(area_vector(mesh_, before)) <= 0) return false;
    }
    return true;
  }

  /// Surfaces stay surfaces where two vertices have no neighbours in common but the third corners
  /// of the triangles that both share.
  [[nodiscard]] bool keeps_links(int onto, int shared) {
    find_neighbours(onto, others_);
    int common = 0;
    for (const auto& [n, ignored] : neighbours_)
      common += std::any_of(others_.begin(), others_.end(),
                            [n = n](const auto& other) { return other.first == n; });
    return common == shared && others_.size() > 3;
  }

  void pull(int v, int onto) {
    for (const int i : around_[v]) {
      Triangle& t = mesh_.triangles[i];
      if (holds(t, onto)) {
        for (const int n : t)
          if (n != v) std::erase(around_[n], i);
        t = {kGone, kGone, kGone};
      } else {
        std::replace(t.begin(), t.end(), v, onto);
        around_[onto].push_back(i);
      }
    }
    around_[v].clear();
  }

  TriangleMesh mesh_;
  FlatVertexOptions options_;
  std::vector<std::vector<int>> around_;  ///< triangles of each vertex; empty: it is gone
  std::vector<std::pair<int, int>> neighbours_, others_;
};

}  // namespace

TriangleMesh drop_flat_vertices(TriangleMesh mesh, const FlatVertexOptions& options) {
  Collapsible collapsible(std::move(mesh), options);
  collapsible.run();
  return std::move(collapsible).rest();
}

}  // namespace condyle
