#include "mesh/orient_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A component with fewer boundary edges than this share of its triangles counts as closed:
/// pinholes of a segmentation, not the rim of a sheet (a sheet of n triangles has about 2 √n of
/// them).
constexpr double kPinholes = 0.005;

struct Neighbour {
  int triangle;
  bool agrees;  ///< the two run through their common edge in opposite directions
};

std::vector<std::vector<Neighbour>> neighbours(const TriangleMesh& mesh,
                                               const std::vector<MeshEdge>& edges) {
  std::vector<std::vector<Neighbour>> result(mesh.triangles.size());
  for (const MeshEdge& e : edges) {
    if (e.count != 2) continue;
    const bool agrees = e.forward[0] != e.forward[1];
    result[e.triangle[0]].push_back({e.triangle[1], agrees});
    result[e.triangle[1]].push_back({e.triangle[0], agrees});
  }
  return result;
}

/// Which triangles to turn for a component that contains `seed`: marks and lists the component on
/// the way.
std::vector<int> make_consistent(const std::vector<std::vector<Neighbour>>& links,
                                 int seed,
                                 std::vector<bool>& turned,
                                 std::vector<bool>& seen) {
  std::vector<int> members = {seed};
  seen[seed] = true;
  for (std::size_t next = 0; next < members.size(); ++next)
    for (const auto& [other, agrees] : links[members[next]]) {
      if (seen[other]) continue;
      seen[other] = true;
      turned[other] = turned[members[next]] != !agrees;
      members.push_back(other);
    }
  const auto count =
      std::count_if(members.begin(), members.end(), [&](int t) { return turned[t]; });
  if (2 * static_cast<std::size_t>(count) > members.size())
    for (const int t : members) turned[t] = !turned[t];
  return members;
}

/// Six times the volume that the triangles enclose as they will be turned, about their own centre.
double enclosed_volume(const TriangleMesh& mesh,
                       const std::vector<int>& members,
                       const std::vector<bool>& turned) {
  Vector3d center = Vector3d::Zero();
  for (const int t : members)
    center += mesh.vertices[mesh.triangles[t][0]] / static_cast<double>(members.size());
  double volume = 0;
  for (const int t : members) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double part = (mesh.vertices[a] - center)
                            .dot((mesh.vertices[b] - center).cross(mesh.vertices[c] - center));
    volume += turned[t] ? -part : part;
  }
  return volume;
}

}  // namespace

std::vector<int> find_components(const TriangleMesh& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<int> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (const MeshEdge& e : edges)
    if (e.count == 2) parent[root(e.triangle[0])] = root(e.triangle[1]);

  const std::vector<Vector3d> areas = triangle_areas(mesh);
  std::vector<double> area(mesh.triangles.size(), 0.0);
  for (std::size_t t = 0; t < areas.size(); ++t) area[root(static_cast<int>(t))] += areas[t].norm();
  std::vector<int> roots;
  for (std::size_t t = 0; t < parent.size(); ++t)
    if (parent[t] == static_cast<int>(t)) roots.push_back(static_cast<int>(t));
  std::stable_sort(roots.begin(), roots.end(), [&](int x, int y) { return area[x] > area[y]; });
  std::vector<int> number(parent.size(), -1), component(parent.size());
  for (std::size_t i = 0; i < roots.size(); ++i) number[roots[i]] = static_cast<int>(i);
  for (std::size_t t = 0; t < parent.size(); ++t) component[t] = number[root(static_cast<int>(t))];
  return component;
}

int orient_components(TriangleMesh& mesh,
                      const std::vector<MeshEdge>& edges,
                      const std::vector<int>& component,
                      std::vector<bool>& closed) {
  const int n = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  std::vector<int> boundary(n, 0);
  for (const MeshEdge& e : edges)
    if (e.count == 1) ++boundary[component[e.triangle[0]]];

  closed.assign(n, false);
  const auto links = neighbours(mesh, edges);
  std::vector<bool> turned(mesh.triangles.size(), false), seen(mesh.triangles.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (seen[t]) continue;
    const std::vector<int> members = make_consistent(links, static_cast<int>(t), turned, seen);
    const int c = component[t];
    closed[c] = boundary[c] <= kPinholes * static_cast<double>(members.size());
    if (closed[c] && enclosed_volume(mesh, members, turned) < 0)
      for (const int m : members) turned[m] = !turned[m];
  }
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return static_cast<int>(std::count(turned.begin(), turned.end(), true));
}

}  // namespace condyle
