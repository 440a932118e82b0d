#include "condyle/pictures/knee_shapes.h"

#include <algorithm>
#include <cmath>

#include "condyle/pictures/surface_shapes.h"
#include "condyle/results/run_view.h"
#include "condyle/results/strain_scale.h"
#include "condyle/scene/ligament_path.h"

namespace condyle {
namespace {

constexpr Paint kBone = {{232, 222, 204}, 0};
constexpr Paint kWrap = {{196, 206, 176}, 0};

SurfaceDescription surface_of(const WrapDescription& wrap) {
  SurfaceDescription surface;
  surface.name = wrap.name;
  surface.body = wrap.body;
  surface.point = wrap.placement.p;
  surface.direction = wrap.placement.R.col(2);
  if (const auto* sphere = std::get_if<WrapSphere>(&wrap.shape)) {
    surface.kind = SurfaceKind::kSphere;
    surface.radius = sphere->radius;
  } else if (const auto* cylinder = std::get_if<WrapCylinder>(&wrap.shape)) {
    surface.kind = SurfaceKind::kCylinder;
    surface.radius = cylinder->radius;
  } else if (const auto* ellipsoid = std::get_if<WrapEllipsoid>(&wrap.shape)) {
    surface.kind = SurfaceKind::kEllipsoid;
    surface.semi_axes = ellipsoid->semi_axes;
    surface.axes = wrap.placement.R;
  } else if (const auto* torus = std::get_if<WrapTorus>(&wrap.shape)) {
    surface.kind = SurfaceKind::kTorus;
    surface.radius = torus->ring;
    surface.minor_radius = torus->tube;
  }
  return surface;
}

/// Where ligaments first come to lie on it, body frame; its own place where none does.
Eigen::Vector3d place_of_touch(const Run& run, std::size_t wrap) {
  for (const PoseResult& pose : run.sweep.poses)
    for (std::size_t i = 0; i < pose.paths.size(); ++i)
      for (std::size_t k = 0; k < pose.paths[i].touches.size(); ++k) {
        const LineTouch& touch = pose.paths[i].touches[k];
        const int index = wrap_on_path(run.scene, run.scene.ligaments[i], static_cast<int>(k));
        if (touch.touching && index == static_cast<int>(wrap)) return touch.P;
      }
  return run.scene.wraps[wrap].placement.p;
}

}  // namespace

std::vector<RigidTransform> body_poses(const Scene& scene, const RigidTransform& X_BA) {
  const RigidTransform X_PB = body_pose(scene, X_BA, tibia_body(scene)).inverse();
  std::vector<RigidTransform> poses;
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body)
    poses.push_back(X_PB * body_pose(scene, X_BA, body));
  return poses;
}

std::vector<BodyShape> body_shapes(const Run& run, double spacing) {
  std::vector<BodyShape> shapes;
  for (const BodyMesh& bone : run.bodies) {
    const int body = body_named(run.scene, bone.name);
    if (body < 0 || bone.mesh.triangles.empty()) continue;
    shapes.push_back({body, Layer::kBone, 0.05, is_closed(bone.mesh), shade(bone.mesh, kBone), -1});
  }
  for (std::size_t i = 0; i < run.scene.surfaces.size(); ++i) {
    const SurfaceDescription& surface = run.scene.surfaces[i];
    const RunPatch* patch = patch_of(run, surface.name);
    if (surface.kind == SurfaceKind::kPatch && !patch) continue;
    shapes.push_back({surface.body, Layer::kSolid, 0.16, false,
                      patch
                          ? patch_shape(Patch(patch->data), kCartilage, spacing)
                          : exact_shape(surface, kCartilage, place_of_interest(run, surface.body)),
                      static_cast<int>(i)});
  }
  for (std::size_t i = 0; i < run.scene.wraps.size(); ++i) {
    const WrapDescription& wrap = run.scene.wraps[i];
    if (wrap.fit) continue;  // there the bone is seen
    const bool endless = std::holds_alternative<WrapCylinder>(wrap.shape);
    shapes.push_back({wrap.body, Layer::kBone, 0.05, !endless,
                      exact_shape(surface_of(wrap), kWrap, place_of_touch(run, i)), -1});
  }
  return shapes;
}

PictureScales picture_scales(const Run& run, double size) {
  PictureScales scales;
  const std::vector<LigamentDescription>& ligaments = run.scene.ligaments;
  const auto strained = [](const LigamentDescription& ligament) {
    return has_strain(ligament.law);
  };
  scales.strain_known = std::any_of(ligaments.begin(), ligaments.end(), strained);
  scales.some_unstrained =
      scales.strain_known && !std::all_of(ligaments.begin(), ligaments.end(), strained);
  double tension = 1, contact = 1, low = 1e300, high = -1e300;
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    low = std::min(low, pose.value);
    high = std::max(high, pose.value);
    for (const LigamentResult& ligament : pose.ligaments)
      tension = std::max(tension, ligament.force);
    for (const ContactResult& c : pose.contacts) contact = std::max(contact, std::abs(c.force));
  }
  const StrainScale strain = strain_scale(run);
  scales.ligament_top = scales.strain_known ? strain.top : round_up_nicely(tension);
  scales.ligament_greatest = scales.strain_known ? strain.greatest : tension;
  scales.force_top = contact;
  scales.size = size;
  scales.arrow_mm_per_n = size * 35 / contact;
  if (low <= high) scales.sweep_low = low, scales.sweep_high = high;
  scales.tube_radius = size * ligament_radius(run.scene);
  return scales;
}

}  // namespace condyle
