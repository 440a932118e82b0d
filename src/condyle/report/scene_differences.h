#pragma once

/// What differs in the scenes of several runs, by the names of their tables and keys, whatever their
/// order, their comments and their blanks.

#include <optional>
#include <string>
#include <vector>

namespace condyle {

struct SceneDifference {
  std::string where;  ///< "ligament aACL"; empty at the top of the file
  std::string what;   ///< "stiffness", "ends[2].at"; empty where not all scenes have such a table
  /// As each scene writes it, or nothing where it does not; of a whole table "there".
  std::vector<std::optional<std::string>> values;
  std::vector<double> numbers;  ///< where all are numbers, one for each scene; else empty
};

/// In the order of the first scene. Of lists without names the items are counted from 1. Throws
/// InputError for a text that is not TOML.
[[nodiscard]] std::vector<SceneDifference> scene_differences(const std::vector<std::string>& texts);

/// "1800 (+20 %)": a value of a scene beside the number of the first one.
[[nodiscard]] std::string value_beside_first(const SceneDifference& difference, std::size_t scene);

}  // namespace condyle
