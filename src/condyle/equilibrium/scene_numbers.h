#pragma once

/// From numbers of a described knee (scene/parameter_kind.h) to the parameters of its model: a vector
/// is three, and a layer that lies in several pairs is one parameter of each.

#include <string>
#include <vector>

#include "condyle/equilibrium/model_parameter.h"
#include "condyle/scene/scene.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

/// One number of the scene as a direction in which derivatives are taken.
struct SceneParameter {
  std::string name;  ///< "aACL.stiffness", "aACL.insertion.tibia.x"
  Unit unit;         ///< in which results tell it: 1, mm, N, N/mm^2, N mm or deg
  SceneNumber number;
  int component = 0;                  ///< of a vector: 0 x, 1 y, 2 z
  std::vector<ModelParameter> parts;  ///< the derivatives by these add up
};

/// One or three for each number. Of an insertion that is held which the ligament is described by:
/// its reference strain, else its slack length. Of the model that build_model makes of the scene.
[[nodiscard]] std::vector<SceneParameter> scene_parameters(const Scene& scene,
                                                           const std::vector<SceneNumber>& numbers);

}  // namespace condyle
