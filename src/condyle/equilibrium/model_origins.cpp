#include "condyle/equilibrium/model_origins.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Something through which forces act on a body: a point, or a surface about a point.
struct Arm {
  Vector3d at;
  double radius;
};

/// A surface without bounds stands where it lies nearest to the other one of its pair; a pair is
/// no larger than its smaller surface.
Arm arm_of(const Surface& surface, const Surface& other, const RigidTransform& X_to_other) {
  const Extent own = surface.extent(), opposite = other.extent();
  const double radius = std::min(own.radius, opposite.radius);
  if (std::isinf(radius)) return {own.center, 0};
  if (!std::isinf(own.radius)) return {own.center, radius};
  return {surface.evaluate(surface.seed(X_to_other.inverse() * opposite.center)).c, radius};
}

std::vector<Arm> surfaces_on_A(const Model& model) {
  std::vector<Arm> arms;
  for (const ContactPair& pair : model.pairs)
    arms.push_back(arm_of(*pair.on_A, *pair.on_B, model.start));
  return arms;
}

std::vector<Arm> surfaces_on_B(const Model& model) {
  std::vector<Arm> arms;
  for (const ContactPair& pair : model.pairs)
    arms.push_back(arm_of(*pair.on_B, *pair.on_A, model.start.inverse()));
  return arms;
}

std::vector<Arm> insertions(const Model& model,
                            Vector3d LineElement::*end_of_element,
                            Vector3d KinematicCondition::*end_of_distance) {
  std::vector<Arm> arms;
  for (const LineElement& element : model.elements) arms.push_back({element.*end_of_element, 0});
  for (const KinematicCondition& condition : model.conditions)
    if (condition.kind == ConditionKind::kDistance) arms.push_back({condition.*end_of_distance, 0});
  return arms;
}

std::vector<Arm> insertions_on_A(const Model& model) {
  return insertions(model, &LineElement::s_D, &KinematicCondition::s_D);
}
std::vector<Arm> insertions_on_B(const Model& model) {
  return insertions(model, &LineElement::x_C, &KinematicCondition::x_C);
}

std::vector<Arm> points_of_loads(const Model& model) {
  std::vector<Arm> arms;
  for (const Load& load : model.loads)
    if (!load.moment && !load.custom) arms.push_back({load.at, 0});
  return arms;
}

std::optional<Vector3d> mean_of(const std::vector<Arm>& arms) {
  if (arms.empty()) return std::nullopt;
  Vector3d sum = Vector3d::Zero();
  for (const Arm& arm : arms) sum += arm.at;
  return sum / static_cast<double>(arms.size());
}

/// Root mean square distance from a point [mm]; 0 where only round-off is left.
double spread_of(const std::vector<Arm>& arms, const Vector3d& middle) {
  double sum = 0, farthest = 0;
  for (const Arm& arm : arms) {
    sum += (arm.at - middle).squaredNorm() + arm.radius * arm.radius;
    farthest = std::max(farthest, arm.at.norm());
  }
  const double spread = std::sqrt(sum / std::max<double>(1, static_cast<double>(arms.size())));
  return spread > 1e-12 * farthest ? spread : 0;
}

double mean_length_of_elements(const Model& model) {
  double sum = 0;
  for (const LineElement& element : model.elements)
    sum += (model.start * element.s_D - element.x_C).norm();
  return model.elements.empty() ? 0 : sum / static_cast<double>(model.elements.size());
}

}  // namespace

BodyOrigins middle_of_forces(const Model& model) {
  BodyOrigins middle;
  for (const auto& arms : {points_of_loads(model), insertions_on_A(model), surfaces_on_A(model)})
    middle.A = mean_of(arms).value_or(middle.A);
  middle.B = model.start * middle.A;
  for (const auto& arms : {insertions_on_B(model), surfaces_on_B(model)})
    middle.B = mean_of(arms).value_or(middle.B);
  return middle;
}

double characteristic_length(const Model& model) {
  const Vector3d middle = middle_of_forces(model).A;
  std::vector<Arm> arms = surfaces_on_A(model);
  for (const Arm& insertion : insertions_on_A(model)) arms.push_back(insertion);
  if (const double spread = spread_of(arms, middle); spread > 0) return spread;
  if (const double spread = spread_of(points_of_loads(model), middle); spread > 0) return spread;
  const double length = mean_length_of_elements(model);
  return length > 0 ? length : 1;
}

void move_origins(const BodyOrigins& to, Model& model) {
  std::map<const Surface*, std::shared_ptr<const Surface>> moved;  // a surface may be in two pairs
  const auto move = [&moved](std::shared_ptr<const Surface>& surface, const Vector3d& origin) {
    std::shared_ptr<const Surface>& there = moved[surface.get()];
    if (!there) there = surface->translated(-origin);
    surface = there;
  };
  for (LineElement& element : model.elements) {
    element.x_C -= to.B;
    element.s_D -= to.A;
  }
  for (KinematicCondition& condition : model.conditions) {
    condition.frames = to.into_model(condition.frames);
    condition.x_C -= to.B;
    condition.s_D -= to.A;
  }
  for (Load& load : model.loads) {
    assert(!load.custom);
    load.at -= to.A;
  }
  for (ContactPair& pair : model.pairs) {
    move(pair.on_B, to.B);
    move(pair.on_A, to.A);
    for (Vector3d& point : pair.start) point -= to.B;
  }
  if (model.joint) model.joint = to.into_model(*model.joint);
  model.start = to.into_model(model.start);
  model.origins.B += to.B;
  model.origins.A += to.A;
}

}  // namespace condyle
