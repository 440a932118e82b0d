#pragma once

/// Femur and tibia of a knee with the four patches that are fitted to them.

#include <filesystem>

#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/fit_patch.h"

namespace condyle::test {

struct KneeFiles {
  std::filesystem::path femur, tibia;
  double to_mm = 1;
  Eigen::Vector3d lateral = {0, 0, 1}, anterior = {1, 0, 0}, proximal = {0, 1, 0};
};

/// Two bodies and the four patches of a knee.
inline Scene knee(const KneeFiles& files) {
  Scene scene;
  scene.file = "knee.toml";
  scene.bodies.resize(2);
  scene.bodies[0].name = "femur";
  scene.bodies[0].fixed = true;
  scene.bodies[0].mesh = MeshFile{files.femur, files.to_mm, {}};
  scene.bodies[1].name = "tibia";
  scene.bodies[1].mesh = MeshFile{files.tibia, files.to_mm, {}};
  const auto frame = [&](int body) {
    return AnatomicalFrame{.body = body,
                           .origin = Eigen::Vector3d::Zero(),
                           .lateral = files.lateral,
                           .anterior = files.anterior,
                           .proximal = files.proximal};
  };
  scene.joint = JointDescription{.side = Side::kRight, .femur = frame(0), .tibia = frame(1)};
  for (const Compartment compartment : {Compartment::kMedial, Compartment::kLateral})
    for (const int body : {0, 1}) {
      SurfaceDescription surface;
      surface.name = std::string(compartment == Compartment::kMedial ? "medial " : "lateral ") +
                     (body == 0 ? "condyle" : "plateau");
      surface.body = body;
      surface.kind = SurfaceKind::kPatch;
      surface.patch.compartment = compartment;
      scene.surfaces.push_back(surface);
    }
  return scene;
}
inline KneeFiles phantom_files() {
  const std::filesystem::path meshes = std::filesystem::path(CONDYLE_SOURCE_DIR) / "meshes";
  return {.femur = meshes / "femur.stl", .tibia = meshes / "tibia.stl"};
}

/// The margin of the data that does not count as known [mm].
inline double rim_of(const FittedSurface& fitted, const EdgeSmoothing& edge = kNormalsEdge) {
  return kUncertainRim * edge.least * fitted.report->smoothing_length;
}

}  // namespace condyle::test
