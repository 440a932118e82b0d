#pragma once

/// Tables that name numbers of the knee which are free or vary: [[calibrate.parameter]] of a scene and
/// [[vary]] of a study. Messages name the table by its section.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "condyle/scene/scene.h"
#include "condyle/scene_file/section.h"

namespace condyle {

/// Which numbers were named so far, and on which line: a slack length and its reference strain are one.
using NamedNumbers = std::map<std::tuple<ParameterKind, int, int>, int>;

/// The keys `what`, `of` and `together`. `also`: words that may stand at `what` and which the caller
/// knows, for messages.
[[nodiscard]] CalibrationParameter read_named_numbers(const Section& section,
                                                      const Scene& scene,
                                                      NamedNumbers& named,
                                                      const std::vector<std::string>& also = {});

/// The keys `sd`, by its name, and `normal_sd`; `meaning` of it: "a standard deviation".
void read_deviation(const Section& section,
                    const Scene& scene,
                    const std::string& key,
                    const std::string& meaning,
                    CalibrationParameter& parameter);

/// The key `bounds`, where given: about the scene's own values.
void read_bounds(const Section& section, const Scene& scene, CalibrationParameter& parameter);

/// The key `range` of changes, of factors for stiffnesses and loads, in mm or 1: to numbers that can be.
[[nodiscard]] std::array<double, 2> read_range(const Section& section,
                                               const Scene& scene,
                                               const CalibrationParameter& parameter);

}  // namespace condyle
