#include "condyle/pictures/joint_axes.h"

#include "condyle/pictures/solids.h"

namespace condyle {
namespace {

constexpr double kFemur = 42, kTibia = 30;                // length of arrows [mm]
constexpr double kFemurRadius = 1.0, kTibiaRadius = 0.7;  // [mm]

void add_frame(const AnatomicalFrame& frame,
               const RigidTransform& X_PB,
               double length,
               double radius,
               ShadedMesh& mesh) {
  const Eigen::Vector3d origin = X_PB * frame.origin;
  const auto add = [&](const Eigen::Vector3d& direction, Rgb color) {
    append(mesh, arrow(origin, origin + length * (X_PB.R * direction), radius, {color, 1}));
  };
  add(frame.lateral, kLateralColor);
  add(frame.anterior, kAnteriorColor);
  add(frame.proximal, kProximalColor);
}

}  // namespace

ShadedMesh joint_axes(const Scene& scene,
                      const Staging& staging,
                      const std::vector<RigidTransform>& X_P) {
  ShadedMesh mesh;
  if (!scene.joint) return mesh;
  const AnatomicalFrame &femur = scene.joint->femur, &tibia = scene.joint->tibia;
  if (staging.shows(scene, femur.body))
    add_frame(femur, X_P[static_cast<std::size_t>(femur.body)], kFemur, kFemurRadius, mesh);
  if (staging.shows(scene, tibia.body))
    add_frame(tibia, X_P[static_cast<std::size_t>(tibia.body)], kTibia, kTibiaRadius, mesh);
  return mesh;
}

}  // namespace condyle
