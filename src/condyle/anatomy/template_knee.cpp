#include "condyle/anatomy/template_knee.h"

#include <algorithm>
#include <set>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"
#include "condyle/specimen/mesh_reader.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

AnatomicalFrame anatomical(int body, const BoneFrame& frame) {
  return {.body = body,
          .origin = frame.origin,
          .lateral = frame.lateral,
          .anterior = frame.anterior,
          .proximal = frame.proximal};
}

void check_template(const Scene& scene, const std::filesystem::path& file) {
  const auto refuse = [&](const char* what) {
    throw InputError(file.string() + ": as a template, expected " + what);
  };
  if (!scene.joint) refuse("a scene with [joint]");
  if (scene.ligaments.empty()) refuse("at least one ligament");
  if (!scene.loads.empty() && scene.joint->tibia.body != scene.moving_body())
    refuse("a tibia that moves, since loads are carried over with it");
  for (const AnatomicalFrame& frame : {scene.joint->femur, scene.joint->tibia})
    if (!scene.bodies[static_cast<std::size_t>(frame.body)].mesh) refuse("a mesh for both bones");
}

void move(TriangleMesh& mesh, const RigidTransform& X) {
  for (Vector3d& v : mesh.vertices) v = X * v;
}

/// A frame of the fixed body's in that of the moving one.
BoneFrame carried_back(const BoneFrame& frame, const RigidTransform& X_BA) {
  const Eigen::Matrix3d R = X_BA.R.transpose();
  return {.origin = R * (frame.origin - X_BA.p),
          .lateral = R * frame.lateral,
          .anterior = R * frame.anterior,
          .proximal = R * frame.proximal};
}

std::optional<TriangleMesh> unless_empty(TriangleMesh mesh) {
  if (mesh.triangles.empty()) return std::nullopt;
  return clean_mesh(std::move(mesh)).mesh;
}

}  // namespace

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const std::array<int, 3>& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

TriangleMesh cartilage_of(const Scene& scene, int body) {
  TriangleMesh all;
  std::set<std::filesystem::path> seen;
  for (const SurfaceDescription& surface : scene.surfaces) {
    const std::optional<MeshFile>& file = surface.patch.mesh;
    if (surface.body != body || !file || !seen.insert(file->path).second) continue;
    append(all, load_mesh(*file));
  }
  return all;
}

JointDescription joint_of(
    Side side, int femur, const BoneFrame& femur_frame, int tibia, const BoneFrame& tibia_frame) {
  return {.side = side,
          .femur = anatomical(femur, femur_frame),
          .tibia = anatomical(tibia, tibia_frame)};
}

TemplateKnee load_template(const std::filesystem::path& file) {
  TemplateKnee knee;
  knee.scene = read_scene(file);
  check_template(knee.scene, file);
  const int femur = knee.scene.joint->femur.body, tibia = knee.scene.joint->tibia.body;
  knee.femur = load_body_mesh(knee.scene.bodies[static_cast<std::size_t>(femur)]);
  knee.tibia = load_body_mesh(knee.scene.bodies[static_cast<std::size_t>(tibia)]);

  const bool strain_follows_from_wraps =
      std::any_of(knee.scene.ligaments.begin(), knee.scene.ligaments.end(),
                  [&](const LigamentDescription& ligament) {
                    return !ligament.reference_strain && !has_known_path(knee.scene, ligament);
                  });
  if (strain_follows_from_wraps) {
    std::vector<TriangleMesh> bones(knee.scene.bodies.size());
    bones[static_cast<std::size_t>(femur)] = knee.femur;
    bones[static_cast<std::size_t>(tibia)] = knee.tibia;
    fit_wraps(knee.scene, bones);
  }

  // As they stand at the start pose, in the fixed body's frame.
  const RigidTransform X_BA = start_pose(knee.scene);
  KneeMeshes meshes{knee.femur, knee.tibia, unless_empty(cartilage_of(knee.scene, femur)),
                    unless_empty(cartilage_of(knee.scene, tibia))};
  const bool tibia_moves = tibia == knee.scene.moving_body();
  move(tibia_moves ? meshes.tibia : meshes.femur, X_BA);
  std::optional<TriangleMesh>& moved =
      tibia_moves ? meshes.tibial_cartilage : meshes.femoral_cartilage;
  if (moved) move(*moved, X_BA);
  try {
    knee.shape = recognise_knee(meshes, {.to_mm = 1, .side = knee.scene.joint->side});
  } catch (const InputError& error) {
    throw InputError(file.string() + ": as a template: " + error.what());
  }
  BoneFrame& carried = (tibia_moves ? knee.shape.tibia : knee.shape.femur).frame;
  carried = carried_back(carried, X_BA);

  Scene by_rule = knee.scene;
  by_rule.joint = joint_of(knee.scene.joint->side, femur, knee.shape.femur.frame, tibia,
                           knee.shape.tibia.frame);
  knee.start = joint_coordinates(joint_frames(by_rule), X_BA);
  return knee;
}

}  // namespace condyle
