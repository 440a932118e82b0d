#include "condyle/equilibrium/restore_state.h"

#include <algorithm>

#include "condyle/math/no_number.h"

namespace condyle {
namespace {

bool tells_points(const ContactResult& contact) {
  return std::all_of(contact.points.begin(), contact.points.end(),
                     [](const ContactPointResult& point) {
                       return point.point_ground.allFinite() && point.point_moving.allFinite();
                     });
}

Place place_on(const Surface& surface, const Eigen::Vector3d& point) {
  return surface.closest(point, surface.seed(point));
}

/// What the paths of ligaments kept, where the pose tells how they lay.
std::vector<double> kept_paths(const Model& model, const PoseResult& pose) {
  std::vector<double> kept(path_numbers(model.elements), kNoNumber);
  if (kept.empty() || pose.paths.size() != model.elements.size()) return kept;
  const RigidTransform X = model.origins.into_model(pose.X_BA);
  KeptPaths next(model.elements, kept);
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    std::vector<LineTouch> touches = pose.paths[i].touches;
    for (LineTouch& touch : touches) {
      touch.P -= touch.on_moving ? model.origins.A : model.origins.B;
      touch.Q -= touch.on_moving ? model.origins.A : model.origins.B;
    }
    double* numbers = next.of(model.elements[i]);
    if (numbers != nullptr && !touches.empty())
      model.elements[i].path->keep(touches, ends_of(model.elements[i], X), X, numbers);
  }
  return kept;
}

}  // namespace

bool can_restore(const Model& model, const PoseResult& pose) {
  if (!pose.solved() || !pose.X_BA.p.allFinite() || !pose.X_BA.R.allFinite()) return false;
  if (pose.contacts.size() != model.pairs.size()) return false;
  if (pose.conditions.size() != model.conditions.size()) return false;
  return std::all_of(pose.contacts.begin(), pose.contacts.end(), [](const ContactResult& contact) {
    return !contact.closed || tells_points(contact);
  });
}

EquilibriumState restore_state(const Model& model, const PoseResult& pose) {
  EquilibriumState state;
  state.X = model.origins.into_model(pose.X_BA);
  for (const ConditionResult& condition : pose.conditions)
    state.sigma.push_back(condition.multiplier);
  for (std::size_t i = 0; i < pose.contacts.size(); ++i) {
    const ContactPair& pair = model.pairs[i];
    if (!pose.contacts[i].closed || pair.law) continue;
    for (const ContactPointResult& point : pose.contacts[i].points) {
      state.contacts.push_back({static_cast<int>(i),
                                {place_on(*pair.on_B, point.point_ground - model.origins.B),
                                 place_on(*pair.on_A, point.point_moving - model.origins.A)},
                                point.force});
    }
  }
  state.paths = kept_paths(model, pose);
  return state;
}

}  // namespace condyle
