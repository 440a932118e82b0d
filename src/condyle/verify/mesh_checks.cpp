#include "condyle/verify/mesh_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/results/digest.h"

namespace condyle::verification {
namespace {

constexpr std::size_t kMostPoints = 1200;  ///< of a mesh that are looked at, evenly taken

/// The file's mesh, where its bytes are those that the run was computed from.
TriangleMesh unchanged_mesh(const Run& run,
                            const MeshFile& file,
                            std::vector<std::string>& missing) {
  for (const InputFile& input : run.inputs) {
    if (input.file != file.path.string()) continue;
    try {
      if (sha256_of_file(file.path) == input.sha256)
        return clean_mesh(load_mesh(file.path, file.to_mm)).mesh;
      missing.push_back(input.file + " has changed since: its mesh is not looked at");
    } catch (const InputError& error) {
      missing.push_back(fmt::format("{} is not looked at: {}", input.file, error.what()));
    }
    return {};
  }
  return {};
}

}  // namespace

MeshCheck::MeshCheck(const Run& run, std::vector<std::string>& not_checked) {
  const Scene& scene = run.scene;
  const auto moving = [&](int body) { return body == scene.moving_body(); };
  for (const BodyMesh& body : run.bodies)
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (scene.bodies[i].name == body.name)
        add(fmt::format("mesh of \"{}\"", body.name), moving(static_cast<int>(i)), body.mesh);
  std::vector<std::pair<std::string, int>> loaded;  // by file and body
  for (const SurfaceDescription& surface : scene.surfaces) {
    if (!surface.patch.mesh) continue;
    std::pair key(surface.patch.mesh->path.string(), surface.body);
    if (std::find(loaded.begin(), loaded.end(), key) != loaded.end()) continue;
    loaded.push_back(std::move(key));
    add(surface.patch.mesh->path.filename().string(), moving(surface.body),
        unchanged_mesh(run, *surface.patch.mesh, not_checked));
  }
  for (const RunPatch& patch : run.patches)
    if (std::isfinite(patch.report.max)) explained_ = std::max(explained_, 2 * patch.report.max);
  if (parts_.empty()) not_checked.emplace_back("meshes: the run holds none");
  const auto closed = [](const Part& part) { return part.winding->closed(); };
  if (!parts_.empty() && std::none_of(parts_.begin(), parts_.end(), closed))
    not_checked.emplace_back("meshes: none of them encloses a volume");
}

void MeshCheck::add(std::string name, bool moving, TriangleMesh mesh) {
  if (mesh.triangles.empty()) return;
  Part part{std::move(name), moving, std::make_unique<TriangleMesh>(std::move(mesh)), nullptr};
  part.winding = std::make_unique<Winding>(*part.mesh);
  parts_.push_back(std::move(part));
}

/// X takes the frame of the points to that of the solid.
void MeshCheck::check_pair(const Part& points,
                           const Part& solid,
                           const RigidTransform& X,
                           Ledger& ledger) const {
  if (!solid.winding->closed()) return;
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < points.mesh->vertices.size(); ++i)
    if (solid.winding->box().contains(X * points.mesh->vertices[i])) near.push_back(i);
  const std::size_t stride = near.size() / kMostPoints + 1;
  double deepest = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < near.size(); k += stride) {
    const Eigen::Vector3d p = X * points.mesh->vertices[near[k]];
    if (std::abs(solid.winding->number(p)) < 0.5) continue;
    const double depth = solid.winding->distance(p);
    if (depth > deepest) deepest = depth, place = points.mesh->vertices[near[k]];
  }
  const std::string words =
      fmt::format("{:.2f} mm of {} lie inside {}, at [{:.1f}, {:.1f}, {:.1f}] mm", deepest,
                  points.name, solid.name, place.x(), place.y(), place.z());
  ledger.note(Check::kMesh, deepest, points.name,
              fmt::format("bones passed through each other: {}", words));
  if (deepest > explained_ && deepest > 0.01)
    ledger.warn(points.name + solid.name, deepest,
                fmt::format("{}; the fits explain {:.2f} mm", words, explained_));
}

void MeshCheck::check(const PoseResult& pose, Ledger& ledger) const {
  for (const Part& a : parts_)
    for (const Part& b : parts_)
      if (a.moving != b.moving)
        check_pair(a, b, a.moving ? pose.X_BA : pose.X_BA.inverse(), ledger);
}

}  // namespace condyle::verification
