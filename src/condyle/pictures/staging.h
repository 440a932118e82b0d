#pragma once

/// Which bodies a view shows and where: as they stand, one alone, or the femur taken off the tibia.

#include <vector>

#include "condyle/pictures/camera.h"
#include "condyle/pictures/knee_shapes.h"
#include "condyle/results/run_view.h"

namespace condyle {

struct Staging {
  bool tibia = true, femur = true;
  RigidTransform lift;  ///< of the femur in P
  double lifted = 0;    ///< along the shaft of the tibia [mm]
  double tipped = 0;    ///< lower side to the front [rad]
  [[nodiscard]] bool apart() const { return lifted > 0; }
  [[nodiscard]] bool alone() const { return !tibia || !femur; }
  [[nodiscard]] bool shows(const Scene& scene, int body) const {
    return (tibia || body != tibia_body(scene)) && (femur || body != femur_body(scene));
  }
};

/// The same for all poses of a run.
[[nodiscard]] Staging staging_of(const Run& run, View view);

/// Poses of the bodies in P as the view shows them.
[[nodiscard]] std::vector<RigidTransform> staged_poses(const Scene& scene,
                                                       const Staging& staging,
                                                       const RigidTransform& X_BA);

/// Marks on the bodies that are shown: on both where they are taken apart.
[[nodiscard]] std::vector<ContactMark> staged_marks(const Scene& scene,
                                                    const Staging& staging,
                                                    const PoseResult& pose);

}  // namespace condyle
