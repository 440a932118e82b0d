#pragma once

/// Ligaments whose names differ by a trailing number only (MCLd1, MCLd2 ...) are strands of one
/// bundle, for tables, pictures and plots.

#include <string>
#include <vector>

namespace condyle {

struct LigamentBundle {
  std::string name;                  ///< without the number
  std::vector<std::size_t> members;  ///< indices into Scene::ligaments
};

/// In the order in which the names come first.
[[nodiscard]] std::vector<LigamentBundle> ligament_bundles(const std::vector<std::string>& names);

/// At most about `most` columns: each ligament for itself where there are few. Else by bundles, and
/// where those are still many without the small letters at the end of their names too (ACLam is of
/// ACL).
[[nodiscard]] std::vector<LigamentBundle> ligament_columns(const std::vector<std::string>& names,
                                                           std::size_t most = 12);

}  // namespace condyle
