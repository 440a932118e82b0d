#include "calibration/study_knee.h"

#include "condyle/elements/joint_table.h"
#include "condyle/math/degree.h"
#include "condyle/scene/ligament_bundles.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::calibration_study {
namespace {

constexpr double kNewtonMetre = 1000;

/// Along or about an axis of the tibia's frame, following the tibia, at the frame's origin.
void add_load(Scene& scene, const std::string& name, const Eigen::Vector3d& axis, bool moment) {
  LoadDescription load;
  load.name = name;
  load.body = scene.joint->tibia.body;
  load.moment = moment;
  load.vector = axis;
  load.at = scene.joint->tibia.origin;
  load.follows_body = true;
  scene.calibration->loads.push_back({name, false, static_cast<int>(scene.loads.size())});
  scene.loads.push_back(std::move(load));
}

/// The joint coordinates that are measured, by loads: of the drawer its own alone, or all five.
std::vector<std::size_t> measured(int load, bool all) {
  if (all || load < 0) return {1, 2, 3, 4, 5};
  static constexpr std::size_t kLoaded[] = {4, 1, 2};
  return {kLoaded[load]};
}

Measurement row_of(
    double flexion, int load, double level, std::size_t coordinate, const TestPlan& plan) {
  Measurement row;
  row.test = load < 0 ? "passive" : std::vector<std::string>{"drawer", "varus", "internal"}[load];
  row.flexion = flexion * kDegree;
  row.load = load;
  row.level = level;
  row.index = coordinate;
  row.sd = coordinate < 3 ? plan.sd_angle * kDegree : plan.sd_length;
  return row;
}

}  // namespace

StudyKnee study_knee(const std::filesystem::path& file) {
  StudyKnee knee;
  knee.scene = read_scene(file);
  Scene& scene = knee.scene;
  scene.calibration = CalibrationDescription{};
  for (std::size_t i = 0; i < scene.conditions.size(); ++i)
    if (scene.conditions[i].kind == ConditionKind::kFlexion)
      scene.calibration->flexion = static_cast<int>(i);
  const AnatomicalFrame& tibia = scene.joint->tibia;
  const double side = scene.joint->side == Side::kRight ? 1 : -1;
  add_load(scene, "drawer", tibia.anterior, false);
  add_load(scene, "varus", side * tibia.anterior, true);
  add_load(scene, "internal", side * tibia.proximal, true);
  knee.surfaces = fit_surfaces(scene);
  knee.meshes = body_meshes(scene, knee.surfaces);
  return knee;
}

MeasurementTable planned_table(const StudyKnee& knee, const TestPlan& plan) {
  MeasurementTable table;
  table.file = knee.scene.file;
  const double greatest[] = {plan.drawer, plan.varus * kNewtonMetre, plan.internal * kNewtonMetre};
  const auto add = [&](double flexion, int load, double level) {
    for (const std::size_t coordinate : measured(load, plan.all_coordinates)) {
      table.rows.push_back(row_of(flexion, load, level, coordinate, plan));
      table.rows.back().line = static_cast<int>(table.rows.size()) + 1;
    }
  };
  for (const double flexion : plan.flexions) {
    if (plan.fractions.size() > 2 || plan.all_coordinates) add(flexion, -1, 0);
    for (const int load : {0, 1, 2})
      for (const double fraction : plan.fractions) add(flexion, load, fraction * greatest[load]);
  }
  return table;
}

void free_numbers(StudyKnee& knee, ParameterKind kind, double prior_sd, int body) {
  CalibrationParameter parameter;
  parameter.what = kind;
  parameter.prior_sd = prior_sd;
  parameter.body = body;
  for (std::size_t i = 0; i < knee.scene.ligaments.size(); ++i)
    parameter.of.push_back(static_cast<int>(i));
  knee.scene.calibration->parameters.push_back(parameter);
}

void free_bundle_strains(StudyKnee& knee, double prior_sd) {
  std::vector<std::string> names;
  for (const LigamentDescription& ligament : knee.scene.ligaments) names.push_back(ligament.name);
  for (const LigamentBundle& bundle : ligament_columns(names)) {
    CalibrationParameter parameter;
    parameter.prior_sd = prior_sd;
    parameter.together = true;
    for (const std::size_t i : bundle.members) parameter.of.push_back(static_cast<int>(i));
    knee.scene.calibration->parameters.push_back(parameter);
  }
}

}  // namespace condyle::calibration_study
