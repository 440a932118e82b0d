#include "condyle/mesh/orient_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A component with fewer boundary edges than this share of its triangles counts as closed:
/// pinholes of a segmentation, not the rim of a sheet (a sheet of n triangles has about 2 √n of
/// them).
constexpr double kPinholes = 0.005;

/// Calls visit(from, k, other) for every triangle `other` that is reached from `seed` across side k
/// of `from`, each once, breadth first; `seen` marks them. Returns them all.
template <class Visit>
std::vector<int> walk(const TriangleLinks& links, int seed, std::vector<bool>& seen, Visit visit) {
  std::vector<int> members = {seed};
  seen[seed] = true;
  for (std::size_t next = 0; next < members.size(); ++next)
    for (std::size_t k = 0; k < 3; ++k) {
      const int other = links.across(members[next], k);
      if (other < 0 || seen[other]) continue;
      seen[other] = true;
      visit(members[next], k, other);
      members.push_back(other);
    }
  return members;
}

/// Which triangles to turn for the component that contains `seed`, the fewest; returns all of it.
std::vector<int> make_consistent(const TriangleLinks& links,
                                 int seed,
                                 std::vector<bool>& turned,
                                 std::vector<bool>& seen) {
  std::vector<int> members = walk(links, seed, seen, [&](int from, std::size_t k, int other) {
    turned[other] = turned[from] != !links.agrees(from, k);
  });
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

/// A closed component, and its volume as its triangles were in the file, most of them.
struct Shell {
  std::vector<int> members;
  double volume = 0;
  bool outward = true;  ///< as it shall be
  Eigen::AlignedBox3d box = {};
};

/// Solid angle of a triangle seen from the origin, signed [van Oosterom and Strackee 1983].
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double x = a.norm(), y = b.norm(), z = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
}

bool contains(const TriangleMesh& mesh,
              const std::vector<bool>& turned,
              const Shell& shell,
              const Vector3d& p) {
  double sum = 0;
  for (const int t : shell.members) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double part =
        solid_angle(mesh.vertices[a] - p, mesh.vertices[b] - p, mesh.vertices[c] - p);
    sum += turned[t] ? -part : part;
  }
  return std::abs(sum) > 2 * std::numbers::pi;
}

/// A shell within another one, of triangles that face the other way in the file, is the wall of a cavity: it faces the other
/// way still. All others face outward.
void orient_shells(const TriangleMesh& mesh,
                   std::vector<bool>& turned,
                   std::vector<Shell>& shells) {
  std::stable_sort(shells.begin(), shells.end(), [](const Shell& a, const Shell& b) {
    return std::abs(a.volume) > std::abs(b.volume);
  });
  const std::vector<bool> in_file = turned;
  for (Shell& shell : shells)
    for (const int t : shell.members)
      for (const int v : mesh.triangles[t]) shell.box.extend(mesh.vertices[v]);
  for (std::size_t i = 0; i < shells.size(); ++i) {
    Shell& shell = shells[i];
    const Vector3d& p = mesh.vertices[mesh.triangles[shell.members.front()][0]];
    for (std::size_t k = i; k-- > 0;) {  // the least that may hold it first
      if ((shells[k].volume < 0) == (shell.volume < 0) || !shells[k].box.contains(p) ||
          !contains(mesh, in_file, shells[k], p))
        continue;
      shell.outward = !shells[k].outward;
      break;
    }
    if ((shell.volume < 0) == shell.outward)
      for (const int t : shell.members) turned[t] = !turned[t];
  }
}

}  // namespace

std::vector<int> find_components(const TriangleMesh& mesh, const TriangleLinks& links) {
  std::vector<int> component(mesh.triangles.size());
  std::vector<double> area;
  std::vector<bool> seen(mesh.triangles.size(), false);
  for (std::size_t seed = 0; seed < seen.size(); ++seed) {
    if (seen[seed]) continue;
    const int label = static_cast<int>(area.size());
    double sum = 0;
    for (const int t : walk(links, static_cast<int>(seed), seen, [](int, std::size_t, int) {})) {
      component[t] = label;
      sum += triangle_area(mesh, mesh.triangles[t]).norm();
    }
    area.push_back(sum);
  }
  std::vector<int> order(area.size()), number(area.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int x, int y) { return area[x] > area[y]; });
  for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
  for (int& c : component) c = number[c];
  return component;
}

int orient_components(TriangleMesh& mesh,
                      const TriangleLinks& links,
                      const std::vector<int>& component,
                      std::vector<bool>& closed) {
  const int n = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  std::vector<int> boundary(n, 0);
  for (std::size_t t = 0; t < component.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) boundary[component[t]] += links.is_boundary(t, k);

  closed.assign(n, false);
  std::vector<Shell> shells;
  std::vector<bool> turned(mesh.triangles.size(), false), seen(mesh.triangles.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (seen[t]) continue;
    const std::vector<int> members = make_consistent(links, static_cast<int>(t), turned, seen);
    const int c = component[t];
    closed[c] = boundary[c] <= kPinholes * static_cast<double>(members.size());
    if (closed[c]) shells.push_back({members, enclosed_volume(mesh, members, turned)});
  }
  orient_shells(mesh, turned, shells);
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return static_cast<int>(std::count(turned.begin(), turned.end(), true));
}

}  // namespace condyle
