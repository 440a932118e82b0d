#pragma once

/// What the corners of a lattice's cells would carry in place of its points (layer_lattice.h): their
/// closest points are told from those of the pressed points around them by φ, n and H. Between four of
/// these the errors are of fourth order.

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "condyle/contact/layer_lattice.h"
#include "condyle/contact/layer_law.h"
#include "condyle/contact/layer_packets.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

/// In the frame of the body that carries the other surface.
struct CornerForce {
  double force = 0;                                   ///< Σ w p [N]
  Eigen::Vector3d along_n = Eigen::Vector3d::Zero();  ///< Σ w p n [N]
};

/// The workspace of one thread.
class LayerCornerSums {
 public:
  /// With the points that are pressed at X. Allocates nothing once it was asked of as many corners.
  CornerForce force(const LayerPackets& packets,
                    const RigidTransform& X,
                    const LayerLaw& law,
                    const LayerCorners& corners);

  /// Sums over the points around a corner.
  struct alignas(32) Told {
    double phi_n[4] = {};       ///< φ and n
    double turn_count[4] = {};  ///< how n turns on the way, and how many points
  };

 private:
  std::vector<Told> told_;  ///< of corners; the last of what is none. All 0 between questions
  std::vector<std::uint32_t> touched_;  ///< corners, with room for all
};

}  // namespace condyle
