#pragma once

/// Knees made of the phantom's meshes: moved, cut, made whole, roughened; and what was recognised in them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "condyle/anatomy/recognise_knee.h"
#include "condyle/math/degree.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh_files/load_mesh.h"

namespace condyle::test {

/// Right knee; x anterior, y proximal, z lateral, the origin midway between the posterior condyles.
inline KneeMeshes phantom() {
  const auto read = [](const char* file) { return clean_mesh(load_mesh(file, 1)).mesh; };
  return {read(CONDYLE_SOURCE_DIR "/meshes/femur.stl"),
          read(CONDYLE_SOURCE_DIR "/meshes/tibia.stl"),
          {},
          {}};
}

inline BoneFrame phantom_frame() {
  return {.origin = Eigen::Vector3d::Zero(),
          .lateral = Eigen::Vector3d::UnitZ(),
          .anterior = Eigen::Vector3d::UnitX(),
          .proximal = Eigen::Vector3d::UnitY()};
}

template <class Map>
TriangleMesh mapped(TriangleMesh mesh, const Map& map) {
  for (Eigen::Vector3d& p : mesh.vertices) p = map(p);
  return mesh;
}
template <class Map>
KneeMeshes mapped(KneeMeshes knee, const Map& map) {
  knee.femur = mapped(std::move(knee.femur), map);
  knee.tibia = mapped(std::move(knee.tibia), map);
  if (knee.femoral_cartilage) knee.femoral_cartilage = mapped(*knee.femoral_cartilage, map);
  if (knee.tibial_cartilage) knee.tibial_cartilage = mapped(*knee.tibial_cartilage, map);
  return knee;
}

inline BoneFrame moved(BoneFrame frame, const Eigen::Isometry3d& X) {
  return {.origin = X * frame.origin,
          .lateral = X.linear() * frame.lateral,
          .anterior = X.linear() * frame.anterior,
          .proximal = X.linear() * frame.proximal};
}

/// What passes.
template <class Keep>
TriangleMesh part(const TriangleMesh& mesh, const Keep& keep) {
  std::vector<bool> kept;
  for (const auto& [a, b, c] : mesh.triangles)
    kept.push_back(keep(mesh.vertices[a]) && keep(mesh.vertices[b]) && keep(mesh.vertices[c]));
  return sub_mesh(mesh, kept).mesh;
}

inline TriangleMesh joined(TriangleMesh mesh, const TriangleMesh& other) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({a + first, b + first, c + first});
  return mesh;
}

/// The last millimetres of the phantom's shaft drawn out along y until the bone ends at `end` [mm].
inline TriangleMesh drawn_out(const TriangleMesh& mesh, double end) {
  double last = 0;
  for (const Eigen::Vector3d& p : mesh.vertices)
    if (p.y() * end > last * end) last = p.y();
  const double first = last - std::copysign(3, end), factor = (end - first) / (last - first);
  return mapped(mesh, [&](const Eigen::Vector3d& p) {
    return (p.y() - first) * end > 0
               ? Eigen::Vector3d(p.x(), first + factor * (p.y() - first), p.z())
               : p;
  });
}

/// Each vertex moved along its normal by a normally distributed distance [mm].
inline TriangleMesh roughened(TriangleMesh mesh, double rms, unsigned seed) {
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  std::mt19937 generator(seed);
  std::normal_distribution<double> distance(0, rms);
  for (std::size_t i = 0; i < normals.size(); ++i)
    mesh.vertices[i] += distance(generator) * normals[i];
  return mesh;
}

inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}
/// The largest of the three axes' [rad].
inline double axes_apart(const BoneFrame& a, const BoneFrame& b) {
  return std::max({angle_between(a.lateral, b.lateral), angle_between(a.anterior, b.anterior),
                   angle_between(a.proximal, b.proximal)});
}

inline void expect_frame(const BoneFrame& found,
                         const BoneFrame& truth,
                         double degrees,
                         double mm) {
  EXPECT_LT(axes_apart(found, truth) / kDegree, degrees);
  EXPECT_LT((found.origin - truth.origin).norm(), mm);
}

}  // namespace condyle::test
