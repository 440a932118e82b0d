#pragma once

/// Sums over the pressed points of a side that its wrench and the derivatives of that are made of
/// (layer_side.h), in the frame of the body that carries the other surface; s being the arms of
/// forces p n.

#include <Eigen/Core>

#include "condyle/contact/layer_law.h"
#include "condyle/contact/layer_packets.h"
#include "condyle/elements/wrench.h"

namespace condyle {

struct LayerMoments {
  double force = 0;                                 ///< Σ w p [N]
  Eigen::Vector3d f = Eigen::Vector3d::Zero();      ///< Σ w p n [N]
  Eigen::Matrix3d s_f = Eigen::Matrix3d::Zero();    ///< Σ w p s nᵀ [N mm]
  Eigen::Matrix3d G = Eigen::Matrix3d::Zero();      ///< Σ w G [N/mm]
  Eigen::Matrix3d S_G = Eigen::Matrix3d::Zero();    ///< Σ w [s]x G [N]
  Eigen::Matrix3d S_G_S = Eigen::Matrix3d::Zero();  ///< Σ w [s]x G [s]x [N mm]
};

/// `share` of the areas; arms from `origin`.
[[nodiscard]] LayerMoments layer_moments(const LayerPackets& packets,
                                         const LayerLaw& law,
                                         double share,
                                         const Eigen::Vector3d& origin);

/// Of points fixed on A, all in the frame of B.
void add_to_wrench_of_A(const LayerMoments& sums, Wrench& wrench);

/// Of points fixed on B, all in the frame of A, n out of A.
void add_to_wrench_of_B(const LayerMoments& sums, const Eigen::Matrix3d& R, Wrench& wrench);

}  // namespace condyle
