#include "condyle/exchange/run_shapes.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

#include "condyle/exchange/shown_poses.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/specimen/surface_mesh.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

bool is_closed(const TriangleMesh& mesh) {
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  return std::all_of(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.count == 2; });
}

/// Of a vertex that no triangle with an area uses: any direction will do.
void fill_normals(std::vector<Vector3d>& normals) {
  for (Vector3d& n : normals) {
    if (!(n.squaredNorm() > 0.5)) n = Vector3d::UnitY();
  }
}

constexpr double kCover = 1;      // [mm] between a patch and the bone that it was fitted to
constexpr double kOverlap = 0.5;  // [mm] of bone that stays below the edge of a patch

/// Which vertices lie under the patch.
void mark_covered(const Patch& patch,
                  const std::vector<Vector3d>& vertices,
                  std::vector<bool>& covered) {
  const std::vector<Vector3d>& net = patch.data().control_points;
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : net) box.extend(p);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (covered[i] || !box.contains(vertices[i])) continue;
    const Place place = patch.closest(vertices[i], patch.seed(vertices[i]));
    covered[i] = (patch.evaluate_frame(place).c - vertices[i]).norm() < kCover &&
                 patch.edge_distance(place) > kOverlap;
  }
}

void drop_covered(const Run& run, RunShape& bone) {
  std::vector<bool> covered(bone.mesh.vertices.size());
  for (const RunPatch& patch : run.patches) {
    if (patch.body == bone.body) mark_covered(Patch(patch.data), bone.mesh.vertices, covered);
  }
  std::erase_if(bone.mesh.triangles, [&](const std::array<int, 3>& t) {
    return covered[t[0]] && covered[t[1]] && covered[t[2]];
  });
}

/// Drops vertices, with their normals, until about `triangles` are left.
void thin_out(RunShape& shape, std::size_t triangles) {
  const TriangleMesh& mesh = shape.mesh;
  if (triangles == 0 || mesh.triangles.size() <= triangles) return;
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  std::vector<float> positions;
  for (const Vector3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(v[k]));
  }
  std::vector<std::uint32_t> kept(corners.size());
  kept.resize(meshopt_simplify(kept.data(), corners.data(), corners.size(), positions.data(),
                               mesh.vertices.size(), 3 * sizeof(float), 3 * triangles, 1.0F, 0,
                               nullptr));
  TriangleMesh thinner;
  std::vector<Vector3d> normals;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (std::size_t i = 0; i + 2 < kept.size(); i += 3) {
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      int& index = number[kept[i + k]];
      if (index < 0) {
        index = static_cast<int>(thinner.vertices.size());
        thinner.vertices.push_back(mesh.vertices[kept[i + k]]);
        normals.push_back(shape.normals[kept[i + k]]);
      }
      triangle[k] = index;
    }
    thinner.triangles.push_back(triangle);
  }
  shape.mesh = std::move(thinner);
  shape.normals = std::move(normals);
}

SurfaceMesh mesh_of(const Run& run, const SurfaceDescription& surface, double spacing) {
  if (surface.kind != SurfaceKind::kPatch)
    return exact_mesh(surface, place_of_interest(run, surface.body));
  const RunPatch* patch = patch_of(run, surface.name);
  return patch == nullptr ? SurfaceMesh() : patch_mesh(Patch(patch->data), spacing);
}

}  // namespace

std::vector<RunShape> run_shapes(const Run& run, const ShapeOptions& options) {
  std::vector<RunShape> shapes;
  for (const BodyMesh& bone : run.bodies) {
    const int body = body_named(run.scene, bone.name);
    if (body < 0 || bone.mesh.triangles.empty()) continue;
    RunShape shape{bone.name + " bone",  body,      true,
                   is_closed(bone.mesh), bone.mesh, vertex_normals(bone.mesh)};
    fill_normals(shape.normals);
    if (options.drop_covered) drop_covered(run, shape);
    thin_out(shape, options.bone_triangles);
    shapes.push_back(std::move(shape));
  }
  for (const SurfaceDescription& surface : run.scene.surfaces) {
    SurfaceMesh mesh = mesh_of(run, surface, options.patch_spacing);
    if (mesh.mesh.triangles.empty()) continue;
    fill_normals(mesh.normals);
    shapes.push_back(
        {surface.name, surface.body, false, false, std::move(mesh.mesh), std::move(mesh.normals)});
  }
  return shapes;
}

}  // namespace condyle
