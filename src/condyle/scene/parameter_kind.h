#pragma once

/// The numbers of a described knee that derivatives, fits and studies refer to; a name in a scene is
/// that of a ligament, a load, a condition or a surface, a dot, and one of the words below.
///
///   kReferenceStrain   reference_strain   r: the slack length is l₀ = L_ref/(1 + r), L_ref the
///                                         length at the start pose [-]
///   kSlackLength       slack_length       l₀ [mm]
///   kStiffness         stiffness          k [N] or as the law has it; by ln k it is k times as much
///   kTransitionStrain  transition_strain  ε_t of a toe-linear law [-]
///   kInsertion         insertion.BODY     a component of an end, frame of its body [mm]
///   kLoadScale         scale              the factor on a load [-]
///   kLoadVector        vector             a component of its vector [N] or [N mm]
///   kLoadPoint         point              a component of its point, A's frame [mm]
///   kConditionValue    value              what is prescribed [rad] or [mm]
///   kSurfaceShift      shift              a surface moved rigidly along an axis of its body's
///                                         frame, in all pairs that it belongs to [mm]
///   kLayerModulus      modulus            a factor on the modulus of a layer, nominally 1 [-]

#include <string>

namespace condyle {

enum class ParameterKind {
  kReferenceStrain,
  kSlackLength,
  kStiffness,
  kTransitionStrain,
  kInsertion,
  kLoadScale,
  kLoadVector,
  kLoadPoint,
  kConditionValue,
  kSurfaceShift,
  kLayerModulus
};

/// A number of a Scene, or the three components of a vector.
struct SceneNumber {
  ParameterKind kind = ParameterKind::kReferenceStrain;
  int index = -1;         ///< of Scene::ligaments, loads, conditions or surfaces
  int body = -1;          ///< kInsertion: on which body
  std::string name = {};  ///< "aACL.insertion.tibia"
};

}  // namespace condyle
