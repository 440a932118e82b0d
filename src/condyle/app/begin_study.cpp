#include "condyle/app/begin_study.h"

#include <system_error>

#include "condyle/app/summary.h"
#include "condyle/input_error.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {

void refuse_to_overwrite(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code unknown;
    if (std::filesystem::equivalent(output, input, unknown))
      throw InputError(output.string() +
                       ": is read by this command, expected another file to write");
  }
}

void refuse_to_overwrite_inputs(const std::filesystem::path& output, const Scene& scene) {
  std::vector<std::filesystem::path> inputs = {scene.file};
  for (const BodyDescription& body : scene.bodies)
    if (body.mesh) inputs.push_back(body.mesh->path);
  for (const SurfaceDescription& surface : scene.surfaces)
    if (surface.patch.mesh) inputs.push_back(surface.patch.mesh->path);
  refuse_to_overwrite(output, inputs);
}

Study begin_study(const Talk& talk,
                  const std::string& scene,
                  const std::string& output,
                  const std::function<void(const Scene&)>& check) {
  check_output_file(output);
  Study study{read_scene(scene), {}, {}};
  refuse_to_overwrite_inputs(output, study.scene);
  check(study.scene);
  const std::vector<InputFile> meshes = mesh_files(study.scene);
  study.surfaces = fit_aloud(talk, study.scene);
  study.run = make_run(study.scene, study.surfaces);
  expect_same(meshes, study.run.inputs);
  tell_warnings(talk, study.run);
  return study;
}

}  // namespace condyle
