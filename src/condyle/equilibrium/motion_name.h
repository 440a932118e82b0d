#pragma once

/// Motions of the moving body in words.

#include <string>

#include "condyle/equilibrium/admissible_motions.h"

namespace condyle {

/// With joint frames the joint coordinates that change most ("internal rotation", "adduction and
/// distraction"), as many as there are motions and one more where a single motion has two large
/// shares. Without, each motion as "a translation along (x, y, z)" or "a rotation about (x, y, z)
/// through (x, y, z) mm" in the ground frame; several are first combined to simple ones.
/// `motions`: independent columns (da, L dπ) at the pose X_BA.
[[nodiscard]] std::string name_motions(const Model& model,
                                       const RigidTransform& X_BA,
                                       const Motions& motions);

/// "name", in its quotes.
[[nodiscard]] std::string quoted(const std::string& name);

/// "a", "a and b", "a, b and c".
[[nodiscard]] std::string joined(const std::vector<std::string>& words);

}  // namespace condyle
