#pragma once

/// Which insertions on the tibia are seen in the view of the plateau, and which lie below it.

#include <vector>

#include "pictures/knee_shapes.h"

namespace condyle {

/// One entry per ligament: true unless all its insertions on the tibia are covered by more than
/// `depth` [mm] of bone or cartilage. Ligaments without an insertion on the tibia are not seen.
[[nodiscard]] std::vector<bool> seen_from_above(const Scene& scene,
                                                const std::vector<BodyShape>& shapes,
                                                double depth = 3);

}  // namespace condyle
