#pragma once

/// Where a contact stands to the edge of a known surface, in words.

#include <string>

#include "condyle/equilibrium/newton.h"

namespace condyle {

/// 'contact "medial" lies 2.3 mm beyond the known part of "medial condyle" at its notch side, 18.2
/// mm medial, 3.1 mm posterior and 4 mm distal of the joint's origin': the surface whose edge is
/// nearer, the side of it and the place in the directions of its body's anatomical frame; without a
/// joint the place in the body's frame [mm].
[[nodiscard]] std::string edge_in_words(const Model& model, const ClosedContact& contact);

/// 'contact "medial" runs over an edge: "medial condyle" ends 0.004 mm deep in the other surface at
/// its posterior end, 20.4 mm medial ...': the place is a point at the edge of a known part,
/// `depth` [mm] deep in the other surface, where the two have no common normal.
[[nodiscard]] std::string rim_in_words(const Model& model, const ClosedContact& rim, double depth);

}  // namespace condyle
