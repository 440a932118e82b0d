#include "accuracy/phantom_truth.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_scene.h"
#include "phantom/exact_bone.h"
#include "phantom/mesh_shape.h"
#include "phantom/roughness.h"
#include "phantom/stl.h"

namespace condyle::accuracy {

namespace {
constexpr double kDegrees = 180 / M_PI;
}

void Spread::add(double error) {
  squares += error * error;
  greatest = std::max(greatest, std::abs(error));
  ++count;
}

double Spread::rms() const { return count > 0 ? std::sqrt(squares / count) : 0; }

void PoseErrors::add(const SweepResult& run, const SweepResult& truth) {
  for (const PoseResult& pose : run.poses) {
    const auto exact = std::find_if(
        truth.poses.begin(), truth.poses.end(),
        [&](const PoseResult& other) { return std::abs(other.value - pose.value) < 1e-9; });
    if (exact == truth.poses.end() || !exact->converged())
      throw std::runtime_error("no exact pose to compare with");
    ++poses;
    if (!pose.converged()) {
      ++failures[name(pose.status)];
      continue;
    }
    ++converged;
    translation.add((pose.X_BA.p - exact->X_BA.p).norm());
    rotation.add(log_rotation(pose.X_BA.R * exact->X_BA.R.transpose()).norm() * kDegrees);
    for (std::size_t i = 0; i < pose.contacts.size(); ++i) {
      const ContactResult &ours = pose.contacts[i], &theirs = exact->contacts[i];
      place.add((ours.resultant_ground - theirs.resultant_ground).norm());
      force.add((ours.force / theirs.force - 1) * 100);
    }
    for (std::size_t i = 0; i < pose.ligaments.size(); ++i)
      ligament.add(pose.ligaments[i].force - exact->ligaments[i].force);
  }
}

void PatchErrors::add(phantom::Bone bone, const Surface& patch) {
  constexpr double kSpacing = 1, kCore = 4;  // [mm]
  for (const Place& place : patch.samples(kSpacing)) {
    if (patch.edge_distance(place) < kCore) continue;
    const SurfacePoint at = patch.evaluate(place), truth = phantom::surface_point(bone, at.c);
    position.add((at.c - truth.c).norm());
    normal.add(std::acos(std::min(1.0, at.n.dot(truth.n))) * kDegrees);
    curvature.add((at.K - truth.K).norm() / std::sqrt(2.0));
  }
}

phantom::Bone bone_of(const Scene& scene, const SurfaceDescription& surface) {
  return scene.bodies[surface.body].name == "femur" ? phantom::Bone::kFemur : phantom::Bone::kTibia;
}

Scene phantom_scene(const std::filesystem::path& root, double step_degrees) {
  Scene scene = read_scene(root / "data" / "phantom" / "knee.toml");
  scene.sweep->values.clear();
  for (int i = 0; i * step_degrees <= 90; ++i)
    scene.sweep->values.push_back(i * step_degrees / kDegrees);
  return scene;
}

std::vector<FittedSurface> exact_surfaces(const Scene& scene) {
  std::vector<FittedSurface> surfaces;
  for (const SurfaceDescription& s : scene.surfaces) {
    const int side = s.patch.compartment == Compartment::kMedial ? -1 : 1;
    surfaces.push_back(
        {std::make_shared<phantom::ExactBone>(bone_of(scene, s), side), std::nullopt, {}});
  }
  return surfaces;
}

MeshFiles::MeshFiles(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::filesystem::create_directories(folder_);
}

MeshFiles::~MeshFiles() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

const TriangleMesh& MeshFiles::mesh(phantom::Bone bone, const Texture& texture) {
  const auto [found, added] = made_.try_emplace({bone, texture});
  if (!added) return found->second;
  if (texture.roughness == 0) return found->second = phantom::mesh_bone(bone, texture.cell);
  TriangleMesh rough = mesh(bone, {texture.cell, 0, 0, 0});
  phantom::roughen(
      bone, {texture.roughness, texture.correlation, static_cast<std::uint64_t>(texture.seed)},
      rough);
  return found->second = std::move(rough);
}

void MeshFiles::write(const Texture& texture, Scene& scene) {
  const Texture wanted = texture.roughness == 0 ? Texture{texture.cell, 0, 0, 0} : texture;
  for (BodyDescription& body : scene.bodies) {
    const phantom::Bone bone = body.name == "femur" ? phantom::Bone::kFemur : phantom::Bone::kTibia;
    const std::filesystem::path file = folder_ / (body.name + ".stl");
    const std::string bytes = phantom::binary_stl(mesh(bone, wanted), "condyle accuracy study");
    std::ofstream out(file, std::ios::binary);
    if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
      throw std::runtime_error("cannot write " + file.string());
    body.mesh = MeshFile{file, 1, {}};
  }
}

}  // namespace condyle::accuracy
