#pragma once

/// Which insertions on a body are seen in the view that shows it alone, and which lie behind it.

#include <vector>

#include "condyle/pictures/knee_shapes.h"

namespace condyle {

/// One entry per ligament: true unless all its insertions on `body` are covered by more than
/// `depth` [mm] of bone or cartilage. Ligaments without an insertion there are not seen. Rows of
/// R_VB: right, up, towards the viewer, in the frame of the body.
[[nodiscard]] std::vector<bool> seen_insertions(const Scene& scene,
                                                const std::vector<BodyShape>& shapes,
                                                int body,
                                                const Eigen::Matrix3d& R_VB,
                                                double depth = 3);

}  // namespace condyle
