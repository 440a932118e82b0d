#pragma once

/// One knee told in other frames: the scene, its meshes and its surfaces with the frames of their
/// bodies set elsewhere, and poses brought back. What a scanner with its zero elsewhere would have
/// said.

#include <fmt/os.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/math/rotation.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/scene/scene.h"
#include "condyle/scene/start_pose.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/patch.h"

namespace condyle::test {

/// Point p of a body is told as B * p or A * p, by whether the body is fixed or moves.
struct Move {
  RigidTransform B, A;
};

inline RigidTransform to(const Eigen::Vector3d& p) { return {Eigen::Matrix3d::Identity(), p}; }

class MovedScene {
 public:
  MovedScene(const Scene& original, const Move& move) : move_(move), moved_(original) {
    move_bodies(original);
    if (moved_.joint) {
      move_frame(moved_.joint->femur);
      move_frame(moved_.joint->tibia);
    }
    for (SurfaceDescription& surface : moved_.surfaces) move_surface(surface);
    for (ContactDescription& contact : moved_.contacts)
      for (Eigen::Vector3d& point : contact.start) point = move_.B * point;
    for (WrapDescription& wrap : moved_.wraps) {
      wrap.placement = of(wrap.body) * wrap.placement;
      if (wrap.fit) wrap.fit->side = of(wrap.body) * wrap.fit->side;
    }
    for (LigamentDescription& ligament : moved_.ligaments) {
      move_ends(ligament.ends);
      for (std::size_t i = 0; i < ligament.path.sides.size(); ++i) {
        const auto wrap = static_cast<std::size_t>(ligament.path.wraps[i]);
        ligament.path.sides[i] = of(moved_.wraps[wrap].body) * ligament.path.sides[i];
      }
    }
    for (std::size_t i = 0; i < moved_.conditions.size(); ++i) move_condition(i);
    for (LoadDescription& load : moved_.loads) {
      load.at = of(load.body) * load.at;
      load.vector = (load.follows_body ? move_.A : move_.B).R * load.vector;
    }
    if (!moved_.simulation) return;
    moved_.simulation->gravity = move_.B.R * moved_.simulation->gravity;
    for (DamperDescription& damper : moved_.simulation->dampers) move_ends(damper.ends);
  }

  /// A translation that is prescribed is that of O_A, and a Cardan angle that of A's frame in B's:
  /// with other frames they are other motions. Boxes of regions stand along the axes of the frame.
  static bool can(const Scene& scene, const Move& move) {
    const bool moves_A = !move.A.p.isZero(0);
    const bool turns = !move.A.R.isIdentity(0) || !move.B.R.isIdentity(0);
    const auto holds = [&scene](ConditionKind kind) {
      return std::any_of(scene.conditions.begin(), scene.conditions.end(),
                         [kind](const ConditionDescription& c) { return c.kind == kind; });
    };
    const bool boxes = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                   [](const auto& s) { return s.patch.region_box.has_value(); });
    if (holds(ConditionKind::kTranslation) && (moves_A || turns)) return false;
    if (holds(ConditionKind::kRotation) && turns) return false;
    return !(boxes && turns);
  }

  [[nodiscard]] const Scene& scene() const { return moved_; }

  /// Instead of reading the moved files.
  [[nodiscard]] MeshReader mesh_reader() const {
    return [this](const MeshFile& file) {
      TriangleMesh mesh = load_mesh(file.path, file.to_mm);
      for (Eigen::Vector3d& p : mesh.vertices) p = of(body_of(file)) * p;
      return mesh;
    };
  }

  /// The moved meshes as files in the folder, in mm with all digits; the scene names them from then
  /// on.
  void write_meshes(const std::filesystem::path& folder) {
    int count = 0;
    const MeshReader read = mesh_reader();
    const auto write = [&](MeshFile& file) {
      const TriangleMesh mesh = read(file);
      const std::filesystem::path path = folder / fmt::format("{}.obj", ++count);
      fmt::ostream out = fmt::output_file(path.string());
      for (const Eigen::Vector3d& p : mesh.vertices)
        out.print("v {:.17g} {:.17g} {:.17g}\n", p.x(), p.y(), p.z());
      for (const auto& [a, b, c] : mesh.triangles) out.print("f {} {} {}\n", a + 1, b + 1, c + 1);
      return MeshFile{path, 1, {}};
    };
    Scene named = moved_;
    for (std::size_t i = 0; i < named.surfaces.size(); ++i)
      if (auto& mesh = named.surfaces[i].patch.mesh) mesh = write(*moved_.surfaces[i].patch.mesh);
    for (std::size_t b = 0; b < named.bodies.size(); ++b)
      if (auto& mesh = named.bodies[b].mesh) mesh = write(*moved_.bodies[b].mesh);
    moved_ = std::move(named);
  }

  /// Surfaces that were fitted in the frames of the original.
  [[nodiscard]] std::vector<FittedSurface> surfaces(std::vector<FittedSurface> fitted) const {
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      const SurfaceDescription& description = moved_.surfaces[i];
      const RigidTransform& X = of(description.body);
      fitted[i].bone.reset();
      if (description.kind != SurfaceKind::kPatch) {
        fitted[i].surface = make_exact_surface(description);
        continue;
      }
      PatchData data = dynamic_cast<const Patch&>(*fitted[i].surface).data();
      for (Eigen::Vector3d& p : data.control_points) p = X * p;
      fitted[i].surface = std::make_shared<const Patch>(std::move(data));
      for (Eigen::Vector3d& p : fitted[i].region.vertices) p = X * p;
    }
    return fitted;
  }

  /// A pose of the moved scene in the frames of the original.
  [[nodiscard]] PoseResult back(PoseResult pose) const {
    const RigidTransform from_B = move_.B.inverse(), from_A = move_.A.inverse();
    pose.X_BA = from_B * pose.X_BA * move_.A;
    for (ContactResult& contact : pose.contacts) {
      contact.resultant_ground = from_B * contact.resultant_ground;
      for (ContactPointResult& point : contact.points) {
        point.point_ground = from_B * point.point_ground;
        point.point_moving = from_A * point.point_moving;
        point.normal_ground = from_B.R * point.normal_ground;
      }
    }
    return pose;
  }

 private:
  [[nodiscard]] const RigidTransform& of(int body) const {
    return body == moved_.fixed_body() ? move_.B : move_.A;
  }
  [[nodiscard]] int body_of(const MeshFile& file) const {
    for (const SurfaceDescription& surface : moved_.surfaces)
      if (surface.patch.mesh && surface.patch.mesh->path == file.path) return surface.body;
    for (std::size_t b = 0; b < moved_.bodies.size(); ++b)
      if (moved_.bodies[b].mesh && moved_.bodies[b].mesh->path == file.path)
        return static_cast<int>(b);
    return -1;
  }

  void move_bodies(const Scene& original) {
    for (std::size_t b = 0; b < moved_.bodies.size(); ++b) {
      BodyDescription& body = moved_.bodies[b];
      const RigidTransform& X = of(static_cast<int>(b));
      if (body.center) body.center = X * *body.center;
      if (body.inertia) body.inertia = Eigen::Matrix3d(X.R * *body.inertia * X.R.transpose());
      if (static_cast<int>(b) != original.moving_body()) continue;
      const RigidTransform start = move_.B * start_pose(original) * move_.A.inverse();
      body.start_translation = start.p;
      if (!body.start_joint_angles) body.start_rotation = log_rotation(start.R);
    }
  }
  void move_frame(AnatomicalFrame& frame) const {
    const RigidTransform& X = of(frame.body);
    frame.origin = X * frame.origin;
    for (Eigen::Vector3d* axis : {&frame.lateral, &frame.anterior, &frame.proximal})
      *axis = X.R * *axis;
  }
  void move_surface(SurfaceDescription& surface) const {
    const RigidTransform& X = of(surface.body);
    surface.point = X * surface.point;
    surface.direction = X.R * surface.direction;
    surface.axes = X.R * surface.axes;
    if (surface.patch.region_box)
      for (Eigen::Vector3d& corner : *surface.patch.region_box) corner = X * corner;
  }
  void move_ends(std::array<Attachment, 2>& ends) const {
    for (Attachment& end : ends) end.at = of(end.body) * end.at;
  }
  void move_condition(std::size_t index) {
    ConditionDescription& condition = moved_.conditions[index];
    if (condition.kind == ConditionKind::kDistance) move_ends(condition.ends);
    if (condition.kind != ConditionKind::kTranslation) return;
    const double shift = condition.axis.dot(move_.B.p);
    condition.value += shift;
    const auto& sweep = moved_.sweep;
    if (!sweep || sweep->varies_load || sweep->index != static_cast<int>(index)) return;
    for (double& value : moved_.sweep->values) value += shift;
  }

  Move move_;
  Scene moved_;
};

}  // namespace condyle::test
