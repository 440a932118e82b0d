#pragma once

/// A compartment of the exact phantom as a contact surface, so that the mechanics can run on the
/// truth itself: what a sweep on fitted patches should come to.
///
/// A `Place` is the point itself. Lengths in mm.

#include "phantom/phantom_shape.h"

namespace condyle::phantom {

class ExactBone : public Surface {
 public:
  /// side: -1 medial, +1 lateral.
  ExactBone(Bone bone, int side, const PhantomParameters& knee = kShippedPhantom)
      : knee_(knee), bone_(bone), side_(side) {}

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override;
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint& at,
                            const Eigen::Vector3d& dc) const override;
  [[nodiscard]] Place closest(const Eigen::Vector3d& p, const Place& start) const override;
  [[nodiscard]] Place seed(const Eigen::Vector3d& p) const override;
  [[nodiscard]] std::vector<Place> samples(double spacing) const override;
  [[nodiscard]] Extent extent() const override;
  [[nodiscard]] std::unique_ptr<Surface> translated(const Eigen::Vector3d& d) const override;

 private:
  [[nodiscard]] Eigen::Vector3d near_surface(const Eigen::Vector3d& p) const;

  PhantomParameters knee_;
  Bone bone_;
  int side_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  ///< of the phantom [mm]
};

}  // namespace condyle::phantom
