#pragma once

/// Ligament insertions of one knee carried to another, against the other's own.

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "condyle/anatomy/carry_points.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/scene_file/read_scene.h"
#include "support/random.h"

namespace condyle::test {

/// A body of a scene: its mesh, frame, and where ligaments are inserted.
struct KneeBone {
  TriangleMesh mesh;
  BoneFrame frame;
  std::vector<std::string> names;
  std::vector<Eigen::Vector3d> insertions;  ///< body frame [mm]

  [[nodiscard]] FramedBone framed() const { return {mesh, frame}; }
};

/// Femur and tibia of a scene.
inline std::array<KneeBone, 2> knee_bones(const std::filesystem::path& file) {
  const Scene scene = read_scene(file);
  std::array<KneeBone, 2> bones;
  for (int b = 0; b < 2; ++b) {
    const AnatomicalFrame& frame = b == 0 ? scene.joint->femur : scene.joint->tibia;
    const MeshFile& mesh = *scene.bodies[frame.body].mesh;
    bones[b].mesh = clean_mesh(load_mesh(mesh.path, mesh.to_mm)).mesh;
    bones[b].frame = {frame.origin, frame.lateral, frame.anterior, frame.proximal};
    for (const LigamentDescription& ligament : scene.ligaments)
      for (const Attachment& end : ligament.ends)
        if (end.body == frame.body) {
          bones[b].names.push_back(ligament.name);
          bones[b].insertions.push_back(end.at);
        }
  }
  return bones;
}

/// The frame turned about any axis [rad] and moved in any direction [mm].
inline BoneFrame disturbed(const BoneFrame& frame, double turn, double shift, Random& random) {
  const Eigen::Matrix3d R = exp_rotation(turn * random.direction());
  return {frame.origin + shift * random.direction(), R * frame.lateral, R * frame.anterior,
          R * frame.proximal};
}

/// Distances, and how often they are within what was estimated.
struct CarriedErrors {
  int count = 0, within = 0, within_twice = 0;
  double squares = 0, worst = 0;  ///< [mm²], [mm]
  std::string worst_name;

  void add(const std::string& name, double error, double uncertainty) {
    ++count;
    within += error <= uncertainty ? 1 : 0;
    within_twice += error <= 2 * uncertainty ? 1 : 0;
    squares += error * error;
    if (error > worst) worst = error, worst_name = name;
  }
  [[nodiscard]] double rms() const { return std::sqrt(squares / std::max(1, count)); }
  [[nodiscard]] std::string line() const {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "%d insertions: rms %.2f mm, worst %.2f mm (%s), %d %% within 1 and %d %% within 2 "
        "estimated deviations",
        count, rms(), worst, worst_name.c_str(), 100 * within / std::max(1, count),
        100 * within_twice / std::max(1, count));
    return text;
  }
};

}  // namespace condyle::test
