#pragma once

/// Numbers of a model that a solver may change from pose to pose, under the names that a scene has for them
/// ("aACL.slack_length", "aACL.insertion.tibia", "drawer.vector"), in the scene's units.

#include <string>
#include <vector>

#include "condyle/equilibrium/scene_numbers.h"
#include "condyle/python/knee.h"

namespace condyle::python {

/// One for a number, three for a vector. Throws InputError, with the line of the scene's reader, for a name of nothing.
[[nodiscard]] std::vector<SceneParameter> numbers_named(const std::string& name,
                                                        const Scene& scene);

/// One of them, with its unit.
struct NumberPlace {
  const KneeModel& knee;
  const SceneParameter& number;
};

/// In the scene's unit. Throws InputError for numbers that are the model's own: of surfaces and layers.
[[nodiscard]] double get(const NumberPlace& place,
                         const Parameters& parameters,
                         const Drive& drive);
/// Throws InputError where the number cannot be that: a slack length of 0 or less.
void set(const NumberPlace& place, double value, Parameters& parameters, Drive& drive);

}  // namespace condyle::python
