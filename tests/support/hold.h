#pragma once

/// Conditions that hold a body at values.

#include <string>

#include "condyle/equilibrium/model.h"

namespace condyle::test {

/// A translation along `axis` or a rotation about the Cardan axis of that number. `value` in rad or
/// mm.
inline KinematicCondition held(ConditionKind kind,
                               const Eigen::Vector3d& axis,
                               int cardan_axis,
                               double value = 0) {
  KinematicCondition condition;
  condition.kind = kind;
  condition.axis = axis;
  condition.cardan_axis = cardan_axis;
  condition.value = value;
  return condition;
}
inline KinematicCondition held(ConditionKind kind, int axis, double value = 0) {
  return held(kind, Eigen::Vector3d::Unit(axis), axis, value);
}

inline void add(Model& model, const std::string& name, const KinematicCondition& condition) {
  model.conditions.push_back(condition);
  model.condition_names.push_back(name);
}
inline void hold(Model& model, ConditionKind kind, int axis, double value = 0) {
  add(model, "hold", held(kind, axis, value));
}

}  // namespace condyle::test
