#pragma once

/// Size along three axes with a small rigid correction, so that one surface lies on another as well
/// as it can without changing its shape.

#include <Eigen/Core>

#include <vector>

#include "condyle/anatomy/surface_pairs.h"

namespace condyle {

/// x -> shift + turn (size x), component by component.
struct Alignment {
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< factors along the three axes [-]
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< [mm]

  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& x) const {
    return shift + turn * size.cwiseProduct(x);
  }
  [[nodiscard]] Eigen::Vector3d normal(const Eigen::Vector3d& n) const {
    return (turn * n.cwiseQuotient(size)).normalized();
  }
};

/// The samples moved, as samples of their own.
[[nodiscard]] SurfaceSamples moved(const SurfaceSamples& samples, const Alignment& by);

/// Least squares over pairs that are found anew after each step, first for one size, then for
/// three. How frames by rule scatter (3 degrees, 4 mm) and how bones differ in proportion decides
/// only what the surfaces leave open.
[[nodiscard]] Alignment align_surfaces(const SurfaceSamples& coarse,
                                       const SurfaceSamples& fine,
                                       const SurfaceSamples& other_coarse,
                                       const SampledSurface& other);

}  // namespace condyle
