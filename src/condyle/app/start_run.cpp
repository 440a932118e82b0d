#include "condyle/app/start_run.h"

#include "condyle/app/make_run.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/scene_page.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {

Run start_run(const Scene& scene) {
  Run run = make_run(scene, fit_surfaces(scene));
  PoseResult pose;
  pose.status = PoseStatus::kConverged;  // it has a place
  pose.X_BA = start_pose(scene);
  if (scene.joint) pose.joint = joint_coordinates(joint_frames(scene), pose.X_BA);
  pose.value = pose.joint.flexion;
  pose.contacts.resize(scene.contacts.size());
  for (const LigamentDescription& ligament : scene.ligaments) {
    const double length = has_known_path(scene, ligament)
                              ? ligament_length(scene, ligament, pose.X_BA)
                              : distance_between(scene, ligament.ends, pose.X_BA);
    const double slack = slack_length(ligament.law);
    pose.ligaments.push_back(
        {length, slack > 0 ? length / slack - 1 : 0, tension(ligament.law, length).force});
  }
  pose.conditions.resize(scene.conditions.size());
  run.sweep.poses.push_back(std::move(pose));
  return run;
}

void write_scene_page(const std::string& file,
                      const Run& run,
                      const std::vector<std::string>& remarks) {
  write_png(file, draw_scene_page(run, remarks));
}

}  // namespace condyle
