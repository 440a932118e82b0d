#include "condyle/specimen/patch_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/mesh/drop_flat_vertices.h"
#include "condyle/mesh/main_parts.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/scene/scene_place.h"
#include "condyle/surface/bone_check.h"
#include "condyle/surface/face_out.h"

namespace condyle {
namespace {

MeshFile mesh_of(const Scene& scene, const SurfaceDescription& surface) {
  if (const MeshFile* mesh = scene.mesh_of(surface)) return *mesh;
  throw InputError(fmt::format(
      "{}: kind = \"patch\" needs a mesh: neither the surface nor its body \"{}\" names one",
      place_of(scene, surface), scene.bodies[surface.body].name));
}

void check_patch(const Scene& scene, const SurfaceDescription& surface) {
  const std::string place = place_of(scene, surface);
  if (!surface.patch.compartment && surface.patch.region_box) return;
  if (!surface.patch.compartment)
    throw InputError(fmt::format(
        "{}: a patch needs compartment = \"medial\" or \"lateral\", or region = {{ box = ... }}",
        place));
  if (!scene.joint)
    throw InputError(fmt::format("{}: compartment is found from [joint], which is missing", place));
  if (surface.body != scene.joint->femur.body && surface.body != scene.joint->tibia.body)
    throw InputError(fmt::format("{}: body \"{}\" is neither the femur nor the tibia of [joint]",
                                 place, scene.bodies[surface.body].name));
}

bool is_femur(const Scene& scene, const PatchSource& source) {
  return scene.joint && source.body == scene.joint->femur.body;
}
bool is_tibia(const Scene& scene, const PatchSource& source) {
  return scene.joint && source.body == scene.joint->tibia.body;
}

bool needs_compartments(const Scene& scene, const PatchSource& source) {
  return std::any_of(source.surfaces.begin(), source.surfaces.end(),
                     [&](int i) { return scene.surfaces[i].patch.compartment.has_value(); });
}
bool needs_axis(const Scene& scene, const PatchSource& source) {
  return is_femur(scene, source) && needs_compartments(scene, source);
}

/// The medial plateau is deeper from front to back than the lateral one, by 12 % on average
/// [Cheng 2009]: the other way round, the knee may be one of the other side.
void suspect_side(const Scene& scene, const TriangleMesh& mesh, PatchSource& source) {
  constexpr double kSuspicious = 0.95;
  const double ratio = plateau_depth_ratio(mesh, bone_frame(scene.joint->tibia, source));
  if (ratio > 0 && ratio < kSuspicious)
    source.notes.push_back(
        fmt::format("warning: the medial plateau is {:.2f} times as deep from front to back as the "
                    "lateral one, "
                    "expected about 1.1: is this a {} knee, or a mirrored mesh?",
                    ratio, scene.joint->side == Side::kRight ? "left" : "right"));
}

/// In whole millimetres, so that moving there and back costs none of the digits of a usual file. A vertex of no triangle
/// may lie anywhere.
Eigen::Vector3d middle_of(const TriangleMesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) used[static_cast<std::size_t>(v)] = 1;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v] != 0) sum += mesh.vertices[v], ++count;
  return (sum / std::max(1.0, count)).array().round();
}

}  // namespace

std::vector<PatchSource> collect_sources(const Scene& scene) {
  std::vector<PatchSource> sources;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const SurfaceDescription& surface = scene.surfaces[i];
    if (surface.kind != SurfaceKind::kPatch) continue;
    check_patch(scene, surface);
    const MeshFile file = mesh_of(scene, surface);
    auto source = std::find_if(sources.begin(), sources.end(), [&](const PatchSource& s) {
      return s.body == surface.body && s.file.is(file);
    });
    if (source == sources.end()) {
      sources.push_back({.file = file,
                         .body = surface.body,
                         .surfaces = {},
                         .middle = Eigen::Vector3d::Zero(),
                         .mesh = {},
                         .shape = {},
                         .axis = {},
                         .turned = false,
                         .notes = {}});
      source = sources.end() - 1;
    }
    source->surfaces.push_back(static_cast<int>(i));
  }
  return sources;
}

BoneFrame bone_frame(const AnatomicalFrame& frame, const PatchSource& source) {
  return {.origin = frame.origin - source.middle,
          .lateral = frame.lateral,
          .anterior = frame.anterior,
          .proximal = frame.proximal};
}

void shift(TriangleMesh& mesh, const Eigen::Vector3d& d) {
  for (Eigen::Vector3d& p : mesh.vertices) p += d;
}

void load_source(const Scene& scene, const MeshReader& read, PatchSource& source) {
  TriangleMesh as_read = read(source.file);
  source.middle = middle_of(as_read);
  shift(as_read, -source.middle);
  source.mesh = clean_mesh(std::move(as_read));
  source.notes = describe(source.mesh.report);
  const auto all = static_cast<int>(source.mesh.mesh.triangles.size());
  if (source.mesh.report.flipped_triangles > 0.9 * all)
    source.notes.push_back(fmt::format(
        "warning: {} of {} triangles faced into the bone, as after mirroring: check the side",
        source.mesh.report.flipped_triangles, all));
  int turned = 0;
  if (is_femur(scene, source))
    turned = face_out_of_femur(source.mesh, bone_frame(scene.joint->femur, source));
  if (is_tibia(scene, source))
    turned = face_out_of_tibia(source.mesh, bone_frame(scene.joint->tibia, source));
  source.turned = turned > 0;
  if (source.turned)
    source.notes.push_back(fmt::format("{} of {} sheets faced into the bone and were turned",
                                       turned, source.mesh.closed.size()));
  source.shape = drop_flat_vertices(source.mesh.mesh);
  const TriangleMesh& mesh = source.shape;
  if (is_tibia(scene, source)) suspect_side(scene, mesh, source);
  try {
    if (is_femur(scene, source)) check_one_knee(mesh, bone_frame(scene.joint->femur, source));
    if (is_tibia(scene, source) && needs_compartments(scene, source)) {
      check_one_knee(mesh, bone_frame(scene.joint->tibia, source));
      check_is_no_femur(source.mesh, bone_frame(scene.joint->tibia, source));
    }
    if (!needs_axis(scene, source)) return;
    std::optional<MainParts> parts;
    if (source.mesh.report.components > 1) parts = main_parts(mesh);
    const TriangleMesh& bone = parts ? parts->mesh : mesh;
    source.axis =
        fit_condylar_axis(bone, vertex_normals(bone), bone_frame(scene.joint->femur, source));
    check_is_femur(*source.axis);
  } catch (const InputError& error) {
    throw error_of_mesh(source.file,
                        fmt::format("{}: {}", source.file.path.string(), error.what()));
  }
}

}  // namespace condyle
