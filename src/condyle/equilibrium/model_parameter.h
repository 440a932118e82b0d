#pragma once

/// One number of a model that a derivative is taken with respect to (sensitivity.h), in the frames of
/// the files: directions are the same as the model's.
/// The kinds and their units stand in scene/parameter_kind.h; of an insertion the law is held, or the
/// strain (Held).

#include <string>

#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/parameters.h"
#include "condyle/scene/parameter_kind.h"

namespace condyle {

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
