#include "condyle/app/start_run.h"

#include "condyle/equilibrium/build_model.h"
#include "condyle/input_error.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/scene_page.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"

namespace condyle {

Run start_run(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  Run run = make_run(scene, surfaces);
  const Model model = build_model(scene, surfaces);
  PoseResult pose;
  begin_pose(
      {model.start, model.joint ? &*model.joint : nullptr, model.elements, {}, model.pairs.size()},
      pose);
  to_file_frames(model.origins, pose);
  pose.status = PoseStatus::kConverged;  // it has a place
  pose.value = pose.joint.flexion;
  pose.conditions.resize(scene.conditions.size());
  run.sweep.poses.push_back(std::move(pose));
  return run;
}

void check_scene_page(const std::string& file) {
  if (ends_like_another_kind(file, ".png"))
    throw InputError(file + ": the picture is PNG, expected a name that ends in .png");
  check_output_file(file);
}

void write_scene_page(const std::string& file,
                      const Run& run,
                      const std::vector<std::string>& remarks) {
  write_png(file, draw_scene_page(run, remarks));
}

}  // namespace condyle
