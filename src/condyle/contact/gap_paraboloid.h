#pragma once

/// The gap near a sample to second order, from the osculating quadrics of both surfaces: where its
/// minimum lies and how low it is. In a shallow valley the samples of either flank differ by more
/// than two minima do; this tells them apart.

#include <Eigen/Core>

#include <optional>

#include "condyle/surface/surface.h"

namespace condyle {

struct PredictedMinimum {
  Eigen::Vector3d point;  ///< in the frame of the other body [mm]
  double gap = 0;         ///< [mm]
};

/// Of a surface point p with outward normal n and curvature tensor K (in the other body's frame, mm
/// and 1/mm) over the other surface's quadric at `opposite`; `gap` is that of p itself. Nothing where
/// the minimum lies farther than `reach` [mm] along a principal direction, since it belongs to
/// another sample, or where the gap is flat along one, or bends downwards along both: on a hill lies
/// no valley. Along one direction in which it does so `reach`/2 is gone.
[[nodiscard]] std::optional<PredictedMinimum> predict_minimum(const Eigen::Vector3d& p,
                                                              const Eigen::Vector3d& n,
                                                              const Eigen::Matrix3d& K,
                                                              const SurfacePoint& opposite,
                                                              double gap,
                                                              double reach);

}  // namespace condyle
