#pragma once

/// One number of a model that a derivative is taken with respect to (sensitivity.h), in the frames of
/// the files: directions are the same as the model's.
///
///   kReferenceStrain   r: the slack length is l₀ = L_ref/(1 + r), L_ref the length at the start pose [-]
///   kSlackLength       l₀ [mm]
///   kStiffness         k [N] or as the law has it; by ln k it is k times as much
///   kTransitionStrain  ε_t of a toe-linear law [-]
///   kInsertion         a component of an end, frame of its body [mm]; law held, or strain (Held)
///   kLoadScale         the factor on a load [-]
///   kLoadVector        a component of its vector [N] or [N mm]
///   kLoadPoint         a component of its point, A's frame [mm]
///   kConditionValue    what is prescribed [rad] or [mm]
///   kSurfaceShift      a surface moved rigidly along an axis of its body's frame, in all pairs that
///                      it belongs to [mm]
///   kLayerModulus      a factor on the modulus of a layer, or of both of a pair, nominally 1 [-]

#include <string>

#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/parameters.h"

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

/// Of which body.
enum class OfBody { kFixed, kMoving, kBoth };

/// What stays as an insertion is moved: the slack length, or the reference strain, and with it the
/// slack length changes in proportion to the length at the start pose.
enum class Held { kSlackLength, kReferenceStrain };

struct ModelParameter {
  ParameterKind kind = ParameterKind::kReferenceStrain;
  std::size_t index = 0;         ///< of Model::elements, loads, conditions or pairs
  OfBody body = OfBody::kFixed;  ///< of an insertion, a surface, a layer; kBoth: of a layer only
  int component = 0;             ///< 0 x, 1 y, 2 z
  Held held = Held::kSlackLength;

  friend bool operator==(const ModelParameter&, const ModelParameter&) = default;
};

/// 'reference strain of "aACL"', 'insertion of "aACL" on the moving body, z'.
[[nodiscard]] std::string name_of(const ModelParameter& parameter, const Model& model);

/// Throws std::invalid_argument with one sentence where the model has no such number, or one that
/// nothing is known of: the strain of a table, the vector of a load that computes itself.
void check_parameter(const ModelParameter& parameter,
                     const Model& model,
                     const Parameters& parameters);

/// The same parameters and drive with that number greater by `by`. Throws as check_parameter, and for
/// surfaces and layers, which are the model's own.
void change(const ModelParameter& parameter,
            double by,
            const Model& model,
            Parameters& parameters,
            Drive& drive);

}  // namespace condyle
