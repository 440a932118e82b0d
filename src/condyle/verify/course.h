#pragma once

/// How a ligament goes at a pose, as the run tells it, and whether that is a string pulled taut:
/// straight pieces that meet each surface along it, and a geodesic on it.

#include "condyle/results/run_file.h"
#include "condyle/scene/scene.h"
#include "condyle/verify/ledger.h"

namespace condyle::verification {

struct Course {
  double length = 0;  ///< [mm]
  /// Ends of the piece that goes from what the fixed body carries to what the moving one does,
  /// ground frame [mm].
  Eigen::Vector3d on_B, on_A;
};

[[nodiscard]] Course course_of(const Scene& scene, const PoseResult& pose, std::size_t ligament);

/// Of a ligament that wraps.
void check_path(const Scene& scene, const PoseResult& pose, std::size_t ligament, Ledger& ledger);

}  // namespace condyle::verification
