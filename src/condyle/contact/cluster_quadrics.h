#pragma once

/// Quadrics fitted to the clusters of a cover, and how far the surface rises over any of its points
/// by them.
///
/// A quadric is fitted when it is first asked for, and kept: most searches ask for few. What is kept
/// depends on the cover alone, not on the order of questions, and belongs to one thread.

#include <vector>

#include "condyle/contact/quadric_fit.h"
#include "condyle/contact/surface_cover.h"

namespace condyle {

struct ClusterQuadric {
  SurfaceCell cell;   ///< holds all samples of the cluster with their cells
  double change = 0;  ///< of the curvature tensor from the quadric's [1/mm]
};

class ClusterQuadrics {
 public:
  /// `cover` has to stay.
  explicit ClusterQuadrics(const SurfaceCover& cover);

  [[nodiscard]] const ClusterQuadric& of(int cluster);
  /// The mean quadric alone of the smallest cluster about a sample whose radius is no less than that
  /// [mm].
  [[nodiscard]] const SurfacePoint& mean_about(int sample, double radius);

  /// Of all cells at a distance between `from` and `to` [mm] from a point within `own` [mm] of one
  /// of the surface.
  [[nodiscard]] Rise rise(const SurfacePoint& of, double own, double from, double to);

 private:
  struct Range;
  void fit(int cluster);
  [[nodiscard]] int sample_amid(const SurfaceCover::Cluster& cluster) const;
  void gather(int cluster, double fine);
  void add_rise(int cluster, const Range& range, Rise& greatest);

  const SurfaceCover* cover_;
  std::vector<ClusterQuadric> fits_;
  std::vector<char> fitted_;
  std::vector<SurfacePoint> means_;
  std::vector<char> has_mean_;
  std::vector<const SurfaceCell*> pieces_;  ///< of the clusters under way, one after the other
};

}  // namespace condyle
