#include "condyle/equilibrium/build_model.h"

#include "condyle/contact/layer_contact.h"
#include "condyle/equilibrium/model_origins.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"

namespace condyle {
namespace {

ContactMode mode_of(ContactState state) {
  switch (state) {
    case ContactState::kClosed:
      return ContactMode::kClosed;
    case ContactState::kOpen:
      return ContactMode::kOpen;
    default:
      return ContactMode::kAuto;
  }
}

/// The laws of pairs that are not rigid, on surfaces that stay where they are from now on.
void set_laws(const Scene& scene, Model& model) {
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (!scene.contacts[i].layer) continue;
    model.pairs[i].mode = ContactMode::kOpen;
    model.pairs[i].law = layer_contact(*scene.contacts[i].layer, model.origins.B);
  }
}

/// The paths of ligaments that wrap, on bodies whose origins stay where they are from now on.
void set_paths(const Scene& scene, Model& model) {
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    model.elements[i].path = ligament_path(scene, scene.ligaments[i], model.origins);
}

}  // namespace

Model build_model(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  const int fixed = scene.fixed_body();
  Model model;
  model.start = start_pose(scene);
  if (scene.joint) model.joint = joint_frames(scene);
  for (const LigamentDescription& ligament : scene.ligaments) {
    const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
    model.elements.push_back({x_C, s_D, ligament.law});
    model.element_names.push_back(ligament.name);
  }
  for (const ConditionDescription& description : scene.conditions) {
    KinematicCondition condition;
    condition.kind = description.kind;
    condition.value = description.value;
    condition.axis = description.axis;
    condition.cardan_axis = description.cardan_axis;
    if (model.joint) condition.frames = *model.joint;
    if (description.kind == ConditionKind::kDistance) {
      const auto [x_C, s_D] = fixed_then_moving(scene, description.ends);
      condition.x_C = x_C;
      condition.s_D = s_D;
    }
    model.conditions.push_back(condition);
    model.condition_names.push_back(description.name);
  }
  for (const LoadDescription& description : scene.loads) {
    Load load;
    load.moment = description.moment;
    load.follows_body = description.follows_body;
    load.vector = description.vector;
    load.at = description.at;
    load.scale = description.scale;
    model.loads.push_back(load);
    model.load_names.push_back(description.name);
  }
  for (const ContactDescription& description : scene.contacts) {
    ContactPair pair;
    pair.name = description.name;
    const auto [first, second] = description.surfaces;
    const bool first_fixed = scene.surfaces[first].body == fixed;
    pair.on_B = surfaces[first_fixed ? first : second].surface;
    pair.on_A = surfaces[first_fixed ? second : first].surface;
    pair.surface_B = scene.surfaces[first_fixed ? first : second].name;
    pair.surface_A = scene.surfaces[first_fixed ? second : first].name;
    pair.mode = mode_of(description.state);
    pair.start = description.start;
    pair.elastic_B = scene.surfaces[first_fixed ? first : second].elastic;
    pair.elastic_A = scene.surfaces[first_fixed ? second : first].elastic;
    model.pairs.push_back(std::move(pair));
  }
  move_origins(middle_of_forces(model), model);
  set_laws(scene, model);
  set_paths(scene, model);
  model.length = characteristic_length(model);
  return model;
}

Swept swept_of(const SweepDescription& sweep) {
  const auto index = static_cast<std::size_t>(sweep.index);
  return sweep.varies_load ? load_scale(index) : condition_value(index);
}

}  // namespace condyle
