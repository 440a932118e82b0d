#pragma once

/// Left or right, told from what differs between the medial and the lateral half of a knee.

#include <string>
#include <vector>

#include "condyle/anatomy/femoral_frame.h"
#include "condyle/anatomy/tibial_frame.h"

namespace condyle {

/// One feature's say.
struct SideEvidence {
  std::string feature;   ///< in words, as positive in most right knees
  double value = 0;      ///< as of a right knee
  std::string unit;      ///< of the value
  double log_ratio = 0;  ///< natural logarithm of the odds for a right knee
};

/// Both shapes as of a right knee.
[[nodiscard]] std::vector<SideEvidence> weigh_femur(const FemoralShape& femur);
/// `mesh` faces outward.
[[nodiscard]] std::vector<SideEvidence> weigh_tibia(const TibialShape& tibia,
                                                    const TriangleMesh& mesh);

}  // namespace condyle
