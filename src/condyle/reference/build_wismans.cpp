#include "condyle/reference/build_wismans.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"

namespace condyle {
namespace {

/// On each body the mean of the springs' ends and of the origins of the heights.
BodyOrigins middle_of_forces(const WismansModel& model) {
  BodyOrigins middle;
  for (const LineElement& spring : model.springs) middle.B += spring.x_C, middle.A += spring.s_D;
  for (const WismansContact& contact : model.contacts) {
    middle.B += contact.on_B.origin;
    middle.A += contact.on_A.origin;
  }
  const auto count = static_cast<double>(model.springs.size() + model.contacts.size());
  return {middle.B / count, middle.A / count};
}

void move_origins(const BodyOrigins& to, WismansModel& model) {
  for (LineElement& spring : model.springs) spring.x_C -= to.B, spring.s_D -= to.A;
  for (Load& load : model.loads) load.at -= to.A;
  for (WismansContact& contact : model.contacts) {
    contact.on_B.origin -= to.B;
    contact.on_A.origin -= to.A;
  }
  model.joint = to.into_model(model.joint);
  model.origins = to;
}

/// Root mean square lever arm of what is fixed to A, about the origin of the model's frame.
double lever_arm(const WismansModel& model) {
  double sum = 0;
  for (const LineElement& spring : model.springs) sum += spring.s_D.squaredNorm();
  for (const WismansContact& contact : model.contacts) sum += contact.on_A.origin.squaredNorm();
  return std::max(1.0, std::sqrt(sum / static_cast<double>(model.springs.size() + 2)));
}

Load load_of(const LoadDescription& description) {
  Load load;
  load.moment = description.moment;
  load.follows_body = description.follows_body;
  load.vector = description.vector;
  load.at = description.at;
  load.scale = description.scale;
  return load;
}

LineElement spring_of(const Scene& scene, const LigamentDescription& ligament) {
  const auto [fixed_end, moving_end] = fixed_then_moving(scene, ligament.ends);
  return {fixed_end, moving_end, ligament.law};
}

}  // namespace

Scene with_quadratic_springs(Scene scene, double strain) {
  scene.wraps.clear();
  for (LigamentDescription& ligament : scene.ligaments) {
    ligament.path = {};
    const auto* law = std::get_if<ToeLinearLaw>(&ligament.law);
    if (law == nullptr) continue;
    const double stretch = strain * law->slack_length;
    const double force = tension(*law, law->slack_length + stretch).force;
    ligament.law = QuadraticLaw{force / (stretch * stretch), law->slack_length};
  }
  return scene;
}

Scene with_closed_contacts(Scene scene) {
  for (ContactDescription& contact : scene.contacts)
    if (contact.state == ContactState::kAuto) contact.state = ContactState::kClosed;
  return scene;
}

void check_wismans_scene(const Scene& scene) {
  const std::string file = scene.file.string();
  if (!scene.joint)
    throw InputError(file +
                     ": [joint] is missing, expected the frames of femur and tibia: Wismans' "
                     "model prescribes the flexion");
  const auto contacts =
      std::count_if(scene.contacts.begin(), scene.contacts.end(),
                    [](const ContactDescription& c) { return c.state != ContactState::kOpen; });
  if (contacts != 2) {
    throw InputError(
        fmt::format("{}: {} [[contact]] that may close, expected 2: Wismans' model has "
                    "one in each compartment",
                    file, contacts));
  }
  if (scene.conditions.size() != 1 || scene.conditions[0].kind != ConditionKind::kFlexion) {
    throw InputError(fmt::format(
        "{}: {} [[condition]], expected one of kind \"flexion\": Wismans' model prescribes nothing "
        "else",
        file, scene.conditions.size()));
  }
}

WismansModel build_wismans_model(const Scene& scene, const std::vector<HeightFit>& heights) {
  check_wismans_scene(scene);
  const int fixed = scene.fixed_body();
  WismansModel model;
  model.joint = joint_frames(scene);
  model.start = start_pose(scene);
  model.flexion = scene.conditions[0].value;
  for (const LigamentDescription& ligament : scene.ligaments)
    model.springs.push_back(spring_of(scene, ligament));
  for (const LoadDescription& load : scene.loads) model.loads.push_back(load_of(load));
  std::size_t next = 0;
  model.scene_contacts = scene.contacts.size();
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const ContactDescription& contact = scene.contacts[c];
    if (contact.state == ContactState::kOpen) continue;
    const auto [first, second] = contact.surfaces;
    const bool first_fixed = scene.surfaces[first].body == fixed;
    model.contacts[next++] = {contact.name, heights[first_fixed ? first : second].surface,
                              heights[first_fixed ? second : first].surface, c};
  }
  move_origins(middle_of_forces(model), model);
  model.length = lever_arm(model);
  return model;
}

}  // namespace condyle
