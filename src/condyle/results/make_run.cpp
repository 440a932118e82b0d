#include "condyle/results/make_run.h"

#include <algorithm>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/results/digest.h"
#include "condyle/results/line_file.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/start_warnings.h"

namespace condyle {
namespace {

std::vector<RunPatch> patches_of(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  std::vector<RunPatch> patches;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto* patch = dynamic_cast<const Patch*>(surfaces[i].surface.get());
    if (patch == nullptr) continue;
    const SurfaceDescription& description = scene.surfaces[i];
    patches.push_back({description.name, description.body, patch->data(),
                       surfaces[i].report.value_or(FitReport{})});
  }
  return patches;
}

}  // namespace

Run make_run(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  Run run{scene, {}, patches_of(scene, surfaces), {}, {}};
  std::vector<TriangleMesh> bones = body_meshes(scene, surfaces, &run.start);
  for (std::string& line : start_warnings(scene, surfaces, bones))
    run.start.push_back(std::move(line));
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].mesh) run.bodies.push_back({scene.bodies[b].name, std::move(bones[b])});
  run.inputs = mesh_files(scene);
  return run;
}

std::vector<InputFile> mesh_files(const Scene& scene) {
  std::vector<InputFile> inputs;
  const auto add = [&](const std::optional<MeshFile>& mesh) {
    if (!mesh) return;
    const std::string file = mesh->path.string();
    for (const InputFile& known : inputs)
      if (known.file == file) return;
    inputs.push_back({file, sha256_of_file(mesh->path)});
  };
  for (const BodyDescription& body : scene.bodies) add(body.mesh);
  for (const SurfaceDescription& surface : scene.surfaces) add(surface.patch.mesh);
  return inputs;
}

void expect_same(const std::vector<InputFile>& before, const std::vector<InputFile>& now) {
  for (std::size_t i = 0; i < before.size() && i < now.size(); ++i)
    if (before[i].sha256 != now[i].sha256)
      throw InputError(now[i].file +
                       ": has changed while it was read, expected a mesh that stays as it is");
}

namespace {

using Paths = std::vector<std::filesystem::path>;

Paths files_of(const Scene& scene) {
  Paths files = {scene.file};
  for (const BodyDescription& body : scene.bodies)
    if (body.mesh) files.push_back(body.mesh->path);
  for (const SurfaceDescription& surface : scene.surfaces)
    if (surface.patch.mesh) files.push_back(surface.patch.mesh->path);
  if (scene.calibration) files.push_back(scene.calibration->measurements);
  return files;
}

[[noreturn]] void refuse(const std::filesystem::path& output, const char* what) {
  throw InputError(output.string() + ": " + what + ", expected another file to write");
}

void refuse_if_one_of(const std::filesystem::path& output, const Paths& files, const char* what) {
  for (const std::filesystem::path& file : files) {
    std::error_code unknown;
    if (std::filesystem::equivalent(output, file, unknown)) refuse(output, what);
  }
}

}  // namespace

void refuse_to_overwrite(const std::filesystem::path& output, const Paths& inputs) {
  refuse_if_one_of(output, inputs, "is read by this command");
}

void refuse_to_overwrite_inputs(const std::filesystem::path& output, const Scene& scene) {
  refuse_to_overwrite(output, files_of(scene));
}

namespace {

/// By its bytes: the paths of a run start where it was computed, which may be elsewhere.
bool holds_source(const std::filesystem::path& file, const Run& run) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  if (!run.scene.text.empty() && bytes_of_file(file) == run.scene.text) return true;
  if (run.inputs.empty()) return false;
  const std::string sha256 = sha256_of_file(file);
  return std::any_of(run.inputs.begin(), run.inputs.end(),
                     [&](const InputFile& input) { return input.sha256 == sha256; });
}

}  // namespace

void refuse_to_overwrite_sources(const std::filesystem::path& output, const Run& run) {
  const char* what = "the run was computed from it";
  refuse_if_one_of(output, files_of(run.scene), what);
  if (holds_source(output, run)) refuse(output, what);
}

}  // namespace condyle
