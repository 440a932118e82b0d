#pragma once

/// Left or right, told from what differs between the medial and the lateral half of a knee.

#include <string>
#include <vector>

#include "condyle/anatomy/femoral_frame.h"
#include "condyle/anatomy/tibial_frame.h"

namespace condyle {

/// One feature's say.
struct SideEvidence {
  std::string figure;    ///< in words, with its value, as of a right knee
  double log_ratio = 0;  ///< natural logarithm of the odds for a right knee
};

/// Both shapes as of a right knee; `tibia` faces outward.
[[nodiscard]] std::vector<SideEvidence> weigh_sides(const FemoralShape& femur,
                                                    const TibialShape& tibia,
                                                    const TriangleMesh& tibia_mesh);

}  // namespace condyle
