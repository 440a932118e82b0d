#include "condyle/study/rough_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "condyle/design/normal_draws.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

constexpr Eigen::Index kWaves = 200;
/// Of a normal number each: a wave vector, and two whose direction is the phase.
constexpr Eigen::Index kNumbersOfWave = 5;

/// In turns.
struct Wave {
  Eigen::Vector3d k;
  double phase = 0;
};

std::vector<Wave> waves_of(const MeshRoughness& roughness, std::uint64_t mesh) {
  const Eigen::VectorXd z =
      normal_draws(roughness.seed, DrawsFor::kRoughness, mesh, kWaves * kNumbersOfWave);
  constexpr double kTurn = 2 * std::numbers::pi;
  std::vector<Wave> waves(kWaves);
  for (int w = 0; w < kWaves; ++w) {
    const Eigen::VectorXd own = z.segment(w * kNumbersOfWave, kNumbersOfWave);
    waves[w] = {own.head<3>() / (roughness.correlation * kTurn),
                std::atan2(own[4], own[3]) / kTurn};
  }
  return waves;
}

/// cos 2πt by the series in the distance from the nearest whole or half turn, to 1e-9; without a branch, so that several
/// are computed at once.
inline double cosine_of_turns(double t) {
  constexpr double kToWhole = 6755399441055744.0;  // 1.5 * 2^52: what is added to it is rounded
  const double r = std::abs(t - ((t + kToWhole) - kToWhole));  // 0 to 1/2
  const double a = 2 * std::numbers::pi * (0.25 - r), b = a * a;
  return a * (1 + b * (-1 / 6. + b * (1 / 120. + b * (-1 / 5040. +
                                                      b * (1 / 362880. + b * (-1 / 39916800. +
                                                                              b / 6227020800.))))));
}

constexpr std::size_t kBlock = 256;

/// Σ cos at up to kBlock points.
void add_waves(const std::vector<Wave>& waves,
               const std::array<std::array<double, kBlock>, 3>& x,
               std::array<double, kBlock>& sum) {
  for (const Wave& wave : waves) {
    const double kx = wave.k.x(), ky = wave.k.y(), kz = wave.k.z(), phase = wave.phase;
    for (std::size_t i = 0; i < kBlock; ++i)
      sum[i] += cosine_of_turns(kx * x[0][i] + ky * x[1][i] + kz * x[2][i] + phase);
  }
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / std::max<double>(1, static_cast<double>(points.size()));
}

/// How far beyond the fitted region the mesh is moved: a region that grows stays within [mm].
constexpr double kBeyondRegion = 8;

/// Vertices in the box about one of the regions.
std::vector<int> vertices_near(const TriangleMesh& mesh,
                               const std::vector<const TriangleMesh*>& regions) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const TriangleMesh* region : regions) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : region->vertices) box.extend(p);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kBeyondRegion);
    boxes.emplace_back(box.min() - margin, box.max() + margin);
  }
  std::vector<int> near;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (std::any_of(boxes.begin(), boxes.end(),
                    [&](const Eigen::AlignedBox3d& box) { return box.contains(mesh.vertices[i]); }))
      near.push_back(static_cast<int>(i));
  return near;
}

/// The anatomical axes of a bone: anterior, proximal, lateral.
Eigen::Matrix3d axes_of(const Scene& scene, int body) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (!scene.joint) return axes;
  for (const AnatomicalFrame* frame : {&scene.joint->femur, &scene.joint->tibia})
    if (frame->body == body)
      axes << frame->anterior.transpose(), frame->proximal.transpose(), frame->lateral.transpose();
  return axes;
}

FittedMesh fitted_mesh(const Scene& scene,
                       const std::vector<FittedSurface>& surfaces,
                       const MeshFile& file,
                       int body) {
  FittedMesh fitted;
  fitted.file = file;
  std::vector<const TriangleMesh*> regions;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SurfaceDescription& surface = scene.surfaces[i];
    if (surface.kind != SurfaceKind::kPatch || !scene.mesh_of(surface)->is(file)) continue;
    regions.push_back(&surfaces[i].region);
    if (fitted.mesh.vertices.empty() && surfaces[i].bone) fitted.mesh = *surfaces[i].bone;
  }
  if (fitted.mesh.vertices.empty()) fitted.mesh = clean_mesh(load_mesh(file)).mesh;
  fitted.frame = {mean_of(fitted.mesh.vertices), axes_of(scene, body)};
  fitted.moved = vertices_near(fitted.mesh, regions);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(fitted.mesh);
  for (const int i : fitted.moved) {
    fitted.places.push_back(fitted.mesh.vertices[i]);
    fitted.normals.push_back(normals[i]);
  }
  return fitted;
}

TriangleMesh roughened(const FittedMesh& fitted,
                       const MeshRoughness& roughness,
                       std::uint64_t number) {
  const std::vector<double> height =
      roughness_field(fitted.places, fitted.frame, roughness, number);
  TriangleMesh mesh = fitted.mesh;
  for (std::size_t i = 0; i < height.size(); ++i)
    mesh.vertices[fitted.moved[i]] += height[i] * fitted.normals[i];
  return mesh;
}

}  // namespace

std::vector<double> roughness_field(const std::vector<Eigen::Vector3d>& points,
                                    const FieldFrame& frame,
                                    const MeshRoughness& roughness,
                                    std::uint64_t mesh) {
  std::vector<double> field(points.size(), 0.0);
  if (roughness.rms == 0) return field;
  const std::vector<Wave> waves = waves_of(roughness, mesh);
  const double scale = roughness.rms * std::sqrt(2. / kWaves);
  std::array<std::array<double, kBlock>, 3> x{};
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d at = frame.axes * (points[first + i] - frame.middle);
      for (int a = 0; a < 3; ++a) x[a][i] = at[a];
    }
    std::array<double, kBlock> sum{};
    add_waves(waves, x, sum);
    for (std::size_t i = 0; i < count; ++i) field[first + i] = scale * sum[i];
  }
  return field;
}

void roughen(TriangleMesh& mesh,
             const MeshRoughness& roughness,
             std::uint64_t number,
             const std::vector<int>& vertices) {
  std::vector<int> moved = vertices;
  if (moved.empty()) {
    moved.resize(mesh.vertices.size());
    std::iota(moved.begin(), moved.end(), 0);
  }
  std::vector<Eigen::Vector3d> places;
  for (const int i : moved) places.push_back(mesh.vertices[i]);
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  const std::vector<double> height =
      roughness_field(places, {mean_of(mesh.vertices)}, roughness, number);
  for (std::size_t i = 0; i < moved.size(); ++i)
    mesh.vertices[moved[i]] += height[i] * normals[moved[i]];
}

std::vector<std::size_t> patches_by_name(const Scene& scene) {
  std::vector<std::size_t> patches;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    if (scene.surfaces[i].kind == SurfaceKind::kPatch) patches.push_back(i);
  std::sort(patches.begin(), patches.end(), [&](std::size_t a, std::size_t b) {
    return scene.surfaces[a].name < scene.surfaces[b].name;
  });
  return patches;
}

std::vector<FittedMesh> fitted_meshes(const Scene& scene,
                                      const std::vector<FittedSurface>& surfaces) {
  std::vector<FittedMesh> meshes;
  for (const std::size_t i : patches_by_name(scene)) {
    const SurfaceDescription& surface = scene.surfaces[i];
    const MeshFile& file = *scene.mesh_of(surface);
    if (std::none_of(meshes.begin(), meshes.end(),
                     [&](const FittedMesh& mesh) { return mesh.file.is(file); }))
      meshes.push_back(fitted_mesh(scene, surfaces, file, surface.body));
  }
  return meshes;
}

std::vector<FittedSurface> roughened_surfaces(const Scene& scene,
                                              const std::vector<FittedSurface>& surfaces,
                                              const std::vector<FittedMesh>& meshes,
                                              const MeshRoughness& roughness) {
  if (meshes.empty()) return surfaces;
  const MeshReader read = [&](const MeshFile& file) {
    const auto mesh = std::find_if(meshes.begin(), meshes.end(),
                                   [&](const FittedMesh& m) { return m.file.is(file); });
    return roughened(*mesh, roughness, static_cast<std::uint64_t>(mesh - meshes.begin()));
  };
  std::vector<FittedSurface> rough = fit_surfaces(scene, {}, read, 1);
  for (std::size_t i = 0; i < rough.size(); ++i) {
    if (scene.surfaces[i].kind != SurfaceKind::kPatch) rough[i] = surfaces[i];
    rough[i].bone = surfaces[i].bone;
  }
  return rough;
}

std::vector<FittedSurface> roughened_surfaces(const Scene& scene,
                                              const std::vector<FittedSurface>& surfaces,
                                              const MeshRoughness& roughness) {
  return roughened_surfaces(scene, surfaces, fitted_meshes(scene, surfaces), roughness);
}

}  // namespace condyle
