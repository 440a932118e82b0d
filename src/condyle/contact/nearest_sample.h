#pragma once

/// The sample of a surface that is nearest to a point which moves little from one time to the next: walked to from
/// the sample before, as long as that is the nearest for certain. It is as far as the largest ball reaches that
/// touches the surface at the sample and holds no other one (medial ball): a point farther away along the normal
/// may be nearer to another sheet of the surface, or lie beyond the centre of its curvature. Balls are measured when
/// a sample is first asked for, and kept [Ma 2012]; it belongs to one thread.

#include <array>
#include <vector>

#include "condyle/contact/surface_cover.h"

namespace condyle {

class NearestSample {
 public:
  explicit NearestSample(const SurfaceCover& cover);

  /// The sample nearest to a point, or one that is at most 5 % farther away or of which the point lies well within
  /// the cell; -1 where none is near it beside its normal: beyond the samples. Walks from the sample `from` (-1: from
  /// any), which becomes the one that was found, near or not. Adds to `looked_at` what a search among all samples
  /// takes, and what measuring takes the first time after each reset, so that the sum does not tell what was asked
  /// before.
  [[nodiscard]] int find(const Eigen::Vector3d& point, int& from, long& looked_at);

  /// Of a point `along` [mm] over a sample's tangent plane, near its normal: is the surface nearest at the sample,
  /// as far as samples tell?
  [[nodiscard]] bool holds(int sample, double along, long& looked_at);

  void reset() { ++now_; }

 private:
  struct Ball {
    double radius = 0;  ///< [mm], where it is less than
    double asked = 0;   ///< which was asked for: else the ball is as large at least [mm]
    int counted = -1;   ///< after which reset
  };

  /// The radius on the side of the unit normal n, or `most` [mm] where it is no less.
  [[nodiscard]] double measure(int sample, const Eigen::Vector3d& n, double most) const;
  void shrink(int cluster, const SurfacePoint& at, const Eigen::Vector3d& n, double& radius) const;

  const SurfaceCover* cover_;
  std::array<std::vector<Ball>, 2> balls_;  ///< over and under each sample
  int now_ = 0;
};

}  // namespace condyle
