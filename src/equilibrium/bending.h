#pragma once

/// How far a surface departs from its osculating quadric: what a bound on the gap has to allow for.
///
/// Measured, not bounded by theory: at a sample of the surface the height of all others over the
/// tangent plane is compared with ½ tᵀ K t. A surface without samples tells nothing, unless it
/// bends evenly (plane, sphere, cylinder).

#include <Eigen/Core>

#include <array>
#include <vector>

#include "surface/surface.h"

namespace condyle {

class Bending {
 public:
  /// `spacing` of the samples [mm].
  Bending(const Surface& surface, double spacing);

  /// The sample nearest to a point of the surface, walking from the sample `start` (-1: from any);
  /// -1 where there are no samples.
  [[nodiscard]] int nearest(const Eigen::Vector3d& point, int start) const;

  /// Least a [1/mm] with |height - ½ tᵀ K t| <= ½ a t² for all |t| <= radius [mm] about a point
  /// near `sample`, where the curvature tensor is K; infinite where the surface turns away too far.
  /// Measured when a sample is first asked for.
  [[nodiscard]] double within(double radius, int sample, const Eigen::Matrix3d& K);

  /// The largest radius [mm] of a table's level, counted from the largest; 0 after the last.
  [[nodiscard]] double level_radius(int level) const { return radii_[level]; }
  static constexpr int kLevels = 5;

 private:
  std::array<double, kLevels> radii_;  ///< descending [mm]
  void measure(std::size_t sample);

  bool even_;
  std::vector<SurfacePoint> samples_;
  std::vector<std::array<int, 8>> neighbours_;
  std::vector<std::array<double, kLevels>> allowance_;  ///< the first negative: not yet measured
};

/// For each point the up to eight nearest others within `radius` [mm]; -1 fills up.
[[nodiscard]] std::vector<std::array<int, 8>> nearest_neighbours(
    const std::vector<Eigen::Vector3d>& points, double radius);

/// Of the heights of `points` over the tangent plane at c: the greatest |h - ½ tᵀ K t|/(½ t²)
/// [1/mm], points nearer than `least` [mm] counted as at that distance. Infinite where a normal
/// turns by more than 60 degrees.
class BendingMeter {
 public:
  BendingMeter(const Eigen::Vector3d& c, const Eigen::Vector3d& n, const Eigen::Matrix3d& K)
      : c_(c), n_(n), K_(K) {}
  [[nodiscard]] double at(const Eigen::Vector3d& point,
                          const Eigen::Vector3d& normal,
                          double least) const;

 private:
  Eigen::Vector3d c_, n_;
  Eigen::Matrix3d K_;
};

}  // namespace condyle
