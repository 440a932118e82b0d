#pragma once

/// How a ligament goes at a pose, as the run tells it, and whether that is a string pulled taut:
/// straight pieces that meet each surface along it, and a geodesic on it.

#include <vector>

#include "condyle/results/run_file.h"
#include "condyle/scene/scene.h"
#include "condyle/verify/ledger.h"

namespace condyle::verification {

/// A wrap on the path of a ligament at a pose, from the end on the fixed body on.
struct WrapAt {
  const WrapDescription* wrap;
  double larger;     ///< half the ligament's thickness [mm]
  RigidTransform X;  ///< from its frame to the ground frame
  [[nodiscard]] Eigen::Vector3d own(const Eigen::Vector3d& ground) const {
    return X.inverse() * ground;
  }
};

[[nodiscard]] std::vector<WrapAt> wraps_at(const Scene& scene,
                                           const RigidTransform& X_BA,
                                           std::size_t ligament);

/// Where the string begins on either body, ground frame [mm]: an end inside a wrap of its own body is on
/// that, closest to it.
struct BeginAt {
  Eigen::Vector3d x;
  int wrap = -1;  ///< on which it is, of wraps_at
};
[[nodiscard]] BeginAt begin_of(const Scene& scene,
                               const RigidTransform& X_BA,
                               std::size_t ligament,
                               bool moving,
                               const std::vector<WrapAt>& wraps);

/// Is the surface left out because the ligament's end lies inside it?
[[nodiscard]] bool passed_over(const LigamentDescription& ligament,
                               const WrapAt& wrap,
                               const RigidTransform& X_BA,
                               const Scene& scene);

/// The deepest place of a straight piece in a surface, about; depth 0 where it runs through none.
struct Deepest {
  double depth = 0;   ///< [mm]
  Eigen::Vector3d x;  ///< ground frame
};
[[nodiscard]] Deepest runs_into(const WrapAt& wrap,
                                const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to);

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
