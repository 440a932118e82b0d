#include "condyle/pictures/shaded_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

using Normals = std::vector<Eigen::Vector3f>;

void normalize(Normals& normals) {
  for (Eigen::Vector3f& n : normals) {
    const float length = n.norm();
    n = length > 0 ? Eigen::Vector3f(n / length) : Eigen::Vector3f::UnitZ();
  }
}

Normals area_weighted(const ShadedMesh& mesh) {
  Normals normals(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f& p = mesh.vertices[a].position;
    const Eigen::Vector3f n = (mesh.vertices[b].position - p).cross(mesh.vertices[c].position - p);
    for (const std::uint32_t i : {a, b, c}) normals[i] += n;
  }
  normalize(normals);
  return normals;
}

Normals averaged_over_neighbours(const ShadedMesh& mesh, const Normals& normals) {
  Normals sums(normals.size(), Eigen::Vector3f::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f all = normals[a] + normals[b] + normals[c];
    for (const std::uint32_t i : {a, b, c}) sums[i] += all;
  }
  normalize(sums);
  return sums;
}

}  // namespace

std::array<std::uint8_t, 4> bytes(const Paint& paint) {
  const double through = std::clamp(paint.through, 0.0, 1.0);
  return {paint.color[0], paint.color[1], paint.color[2],
          static_cast<std::uint8_t>(std::lround(255 * through))};
}

ShadedMesh shade(const TriangleMesh& mesh, const Paint& paint, int smoothing) {
  ShadedMesh shaded;
  shaded.vertices.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& p : mesh.vertices)
    shaded.vertices.push_back({p.cast<float>(), Eigen::Vector3f::Zero(), bytes(paint)});
  shaded.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    shaded.triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                static_cast<std::uint32_t>(c)});
  }
  Normals normals = area_weighted(shaded);
  for (int i = 0; i < smoothing; ++i) normals = averaged_over_neighbours(shaded, normals);
  for (std::size_t i = 0; i < normals.size(); ++i) shaded.vertices[i].normal = normals[i];
  return shaded;
}

bool is_closed(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  double volume = 0;
  const auto edge = [](int a, int b) {
    return (static_cast<std::uint64_t>(a) << 32) | static_cast<std::uint64_t>(b);
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [i, j] : {std::pair{a, b}, {b, c}, {c, a}}) edges.push_back(edge(i, j));
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end() || !(volume > 0)) return false;
  return std::all_of(edges.begin(), edges.end(), [&](std::uint64_t e) {
    const auto a = static_cast<int>(e >> 32), b = static_cast<int>(e & 0xFFFFFFFFu);
    return std::binary_search(edges.begin(), edges.end(), edge(b, a));
  });
}

void append(ShadedMesh& whole, const ShadedMesh& part) {
  const auto first = static_cast<std::uint32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.triangles)
    whole.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace condyle
