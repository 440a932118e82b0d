#include "condyle/study/mesh_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/math/no_number.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/study/rough_mesh.h"

namespace condyle {
namespace {

/// A patch taken for the truth, where its mesh has its vertices.
struct SmoothPatch {
  std::size_t mesh = 0, surface = 0;
  std::vector<VertexOverPatch> vertices;
  std::vector<Eigen::Vector3d> closest;
  PatchTexture texture;
};

/// The knee without noise, from which each draw starts.
struct SmoothKnee {
  std::vector<FittedMesh> meshes;
  std::vector<SmoothPatch> patches;
};

std::size_t mesh_of(const std::vector<FittedMesh>& meshes,
                    const Scene& scene,
                    const SurfaceDescription& surface) {
  const MeshFile& file = *scene.mesh_of(surface);
  return static_cast<std::size_t>(
      std::find_if(meshes.begin(), meshes.end(),
                   [&](const FittedMesh& mesh) { return mesh.file.is(file); }) -
      meshes.begin());
}

/// A vertex over two patches belongs to the first by name.
SmoothKnee smooth_knee(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  SmoothKnee knee;
  knee.meshes = fitted_meshes(scene, surfaces);
  std::vector<std::vector<bool>> taken;
  for (const FittedMesh& mesh : knee.meshes) taken.emplace_back(mesh.mesh.vertices.size(), false);
  for (const std::size_t i : patches_by_name(scene)) {
    const SurfaceDescription& surface = scene.surfaces[i];
    SmoothPatch patch;
    patch.mesh = mesh_of(knee.meshes, scene, surface);
    patch.surface = i;
    const FittedMesh& mesh = knee.meshes[patch.mesh];
    for (const VertexOverPatch& v :
         vertices_over_patch(mesh.mesh, mesh.moved, *surfaces[i].surface, surface.patch.offset)) {
      if (taken[patch.mesh][v.vertex]) continue;
      taken[patch.mesh][v.vertex] = true;
      patch.vertices.push_back(v);
      patch.closest.push_back(v.closest);
    }
    knee.patches.push_back(std::move(patch));
  }
  return knee;
}

/// Where too few vertices tell the noise of a mesh.
void refuse_silent_patches(const SmoothKnee& knee, const Scene& scene) {
  for (const SmoothPatch& patch : knee.patches)
    if (const std::size_t tell = vertices_that_tell(patch.vertices); tell < kFewestOfTexture)
      throw InputError(fmt::format(
          "{}: surface \"{}\": {} vertices lie over its middle, expected at least {} to tell the "
          "noise of its mesh for --uncertainty: a wider region or a finer mesh",
          scene.file.string(), scene.surfaces[patch.surface].name, tell, kFewestOfTexture));
}

void measure_noise(const Scene& scene,
                   const std::vector<FittedSurface>& surfaces,
                   SmoothKnee& knee) {
  for (SmoothPatch& patch : knee.patches)
    patch.texture = texture_beside(patch.vertices, scene.surfaces[patch.surface].patch,
                                   *surfaces[patch.surface].report);
}

std::vector<FittedMesh> noisy_meshes(const SmoothKnee& knee, std::uint64_t seed, int draw) {
  std::vector<FittedMesh> meshes = knee.meshes;
  for (std::size_t p = 0; p < knee.patches.size(); ++p) {
    const SmoothPatch& patch = knee.patches[p];
    const std::uint64_t number = (static_cast<std::uint64_t>(draw) << 16U) + p;
    FittedMesh& mesh = meshes[patch.mesh];
    const std::vector<double> height = roughness_field(
        patch.closest, mesh.frame, {patch.texture.rms, patch.texture.correlation, seed}, number);
    for (std::size_t i = 0; i < height.size(); ++i)
      mesh.mesh.vertices[patch.vertices[i].vertex] =
          patch.closest[i] + height[i] * patch.vertices[i].normal;
  }
  return meshes;
}

/// By poses, then outputs; none where the meshes cannot be fitted.
using Draw = std::optional<std::vector<std::vector<double>>>;

std::vector<double> numbers_of(const std::vector<SensitivityOutput>& outputs,
                               const PoseResult& pose) {
  std::vector<double> numbers(outputs.size(), kNoNumber);
  for (std::size_t i = 0; i < outputs.size() && pose.converged(); ++i)
    numbers[i] = value_of(outputs[i].output, pose);
  return numbers;
}

Draw draw_of(const Scene& scene,
             const std::vector<FittedSurface>& surfaces,
             const std::vector<FittedMesh>& meshes,
             const std::vector<SensitivityOutput>& outputs) {
  try {
    const std::vector<FittedSurface> noisy = roughened_surfaces(scene, surfaces, meshes, {});
    SweepOptions options;
    options.stability = options.events = false;
    const SweepResult result = sweep(scene, noisy, options);
    Draw draw(std::in_place);
    for (const PoseResult& pose : result.poses) draw->push_back(numbers_of(outputs, pose));
    return draw;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Of one output at one pose over the draws that have it.
void spread_of(const std::vector<Draw>& draws,
               std::size_t pose,
               std::size_t output,
               double nominal,
               double& sd,
               double& shift) {
  double n = 0, mean = 0, squares = 0;
  for (const Draw& draw : draws) {
    const double value = draw && pose < draw->size() ? (*draw)[pose][output] : kNoNumber;
    if (!std::isfinite(value)) continue;
    const double from_mean = value - mean;
    mean += from_mean / ++n;
    squares += from_mean * (value - mean);
  }
  sd = n > 1 ? std::sqrt(squares / (n - 1)) : kNoNumber;
  shift = n > 1 ? mean - nominal : kNoNumber;
}

void sum_up(const std::vector<Draw>& draws,
            const std::vector<PoseResult>& poses,
            MeshUncertainty& all) {
  all.sd.assign(all.outputs.size(), std::vector<double>(poses.size(), kNoNumber));
  all.shift = all.sd;
  all.converged.assign(poses.size(), 0);
  for (const Draw& draw : draws) all.failed_fits += draw ? 0 : 1;
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    const std::vector<double> nominal = numbers_of(all.outputs, poses[pose]);
    for (const Draw& draw : draws)
      if (draw && pose < draw->size() &&
          std::any_of((*draw)[pose].begin(), (*draw)[pose].end(),
                      [](double value) { return std::isfinite(value); }))
        ++all.converged[pose];
    for (std::size_t i = 0; i < all.outputs.size(); ++i)
      spread_of(draws, pose, i, nominal[i], all.sd[i][pose], all.shift[i][pose]);
  }
}

}  // namespace

void check_uncertainty(const Scene& scene, const UncertaintyOptions& options) {
  if (options.sweeps < 2)
    throw InputError(fmt::format("--uncertainty={}: expected at least 2 sweeps", options.sweeps));
  if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(),
                   [](const auto& s) { return s.kind == SurfaceKind::kPatch; }))
    throw InputError(fmt::format(
        "{}: no surface is fitted to a mesh, expected one with kind = \"patch\" for --uncertainty",
        scene.file.string()));
  for (const SurfaceDescription& s : scene.surfaces)
    if (s.kind == SurfaceKind::kPatch && s.patch.smoothing == 0)
      throw InputError(fmt::format(
          "{}: surface \"{}\": smoothing = 0 tells no noise from the bone, expected \"auto\", "
          "\"position\" or a length > 0 for --uncertainty",
          scene.file.string(), s.name));
  if (scene.sweep && scene.sweep->arc_length)
    throw InputError(
        fmt::format("{}: [sweep]: path = \"arc length\", expected \"steps\" for --uncertainty",
                    scene.file.string()));
}

void check_noise(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  refuse_silent_patches(smooth_knee(scene, surfaces), scene);
}

std::vector<SensitivityOutput> uncertain_outputs(const Scene& scene) {
  std::vector<SensitivityOutput> outputs = sensitivity_outputs(scene);
  std::erase_if(outputs, [](const SensitivityOutput& output) {
    return output.output.kind == OutputKind::kMultiplier;
  });
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    for (int c = 0; c < 3; ++c)
      outputs.push_back({fmt::format("contacts/{}/resultant_{}", scene.contacts[i].name, "xyz"[c]),
                         {"mm", 1},
                         {OutputKind::kContactResultant, i, c}});
  return outputs;
}

std::shared_ptr<const MeshUncertainty> mesh_uncertainty(const Scene& scene,
                                                        const std::vector<FittedSurface>& surfaces,
                                                        const std::vector<PoseResult>& poses,
                                                        const UncertaintyOptions& options,
                                                        StudyProgress& progress) {
  check_uncertainty(scene, options);
  SmoothKnee knee = smooth_knee(scene, surfaces);
  refuse_silent_patches(knee, scene);
  measure_noise(scene, surfaces, knee);
  const auto all = std::make_shared<MeshUncertainty>();
  all->sweeps = options.sweeps;
  all->outputs = uncertain_outputs(scene);
  for (const SmoothPatch& patch : knee.patches)
    all->surfaces.push_back({scene.surfaces[patch.surface].name, patch.texture});
  std::vector<Draw> draws(static_cast<std::size_t>(options.sweeps));
  const auto make_task = [&] {
    return [&](int k) {
      draws[static_cast<std::size_t>(k)] =
          draw_of(scene, surfaces, noisy_meshes(knee, options.seed, k), all->outputs);
    };
  };
  if (!in_parallel("sweeps", options.sweeps, options.threads, make_task, progress)) return nullptr;
  sum_up(draws, poses, *all);
  return all;
}

}  // namespace condyle
