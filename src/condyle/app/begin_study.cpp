#include "condyle/app/begin_study.h"

#include <system_error>

#include "condyle/app/summary.h"
#include "condyle/input_error.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {

Study begin_study(const Talk& talk,
                  const std::string& scene,
                  const std::string& output,
                  const std::function<void(const Scene&)>& check) {
  check_output_file(output, ".h5");
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
