#pragma once

/// Where two surfaces come near each other: all local minima of the gap between them at a given
/// pose.
///
/// One surface of the pair is covered with samples; each keeps its foot (closest place) on the
/// other one from the pose before. Clusters of samples are passed over where the gap at their
/// centre, less what slope and curvature can take away within their radius, stays above the cutoff.
/// Samples that are nearer than all their neighbours are refined by Newton on the contact
/// conditions at a fixed pose. No pose is trusted that this search has not seen.

#include <array>
#include <memory>
#include <vector>

#include "equilibrium/model.h"

namespace condyle {

/// A local minimum of the gap, or, where the refinement did not settle, the lowest sample.
struct GapMinimum {
  Place on_B, on_A;
  double gap = 0;              ///< [mm], < 0 overlap
  Eigen::Vector3d point_B, n;  ///< point and normal on B, ground frame
  bool refined = false;  ///< normals parallel, an isolated minimum (relative curvature positive)
  double edge = 0;       ///< smaller of the two edge distances [mm]
};

class ContactSearch {
 public:
  /// `spacing` of the samples [mm].
  explicit ContactSearch(const ContactPair& pair, double spacing = 1.2);

  /// All minima with gap < cutoff [mm], lowest first; nearer than `merge` [mm] to a lower one are
  /// left out.
  void find(const RigidTransform& X_BA,
            double cutoff,
            std::vector<GapMinimum>& minima,
            double merge = 0.3);

  /// False for a pair of surfaces without bounds: nothing can be searched there.
  [[nodiscard]] bool has_samples() const { return !places_.empty(); }

 private:
  struct Cluster {
    int center;       ///< a sample
    double radius;    ///< of all samples below it, about that sample [mm]
    double spread;    ///< of the curvature tensors of those samples about the centre's [1/mm]
    int first, last;  ///< range in order_
    int child[2];     ///< -1: leaf
  };
  int build(int first, int last);
  void link_neighbours(double radius);
  void visit(int cluster, const RigidTransform& X_from_to, double cutoff);
  double gap_of(int sample, const RigidTransform& X_from_to);
  [[nodiscard]] double lowest_possible(const Cluster& cluster,
                                       const Eigen::Matrix3d& K_other,
                                       const Eigen::Matrix3d& R) const;
  [[nodiscard]] bool is_lowest_of_neighbours(int sample) const;
  [[nodiscard]] GapMinimum refine(int sample, const RigidTransform& X_BA) const;
  [[nodiscard]] double edge_of(const Place& on_B, const Place& on_A) const;

  const Surface* on_B_;
  const Surface* on_A_;
  bool sampled_on_A_ = true;
  double spacing_;
  std::vector<Place> places_;            ///< samples on the sampled surface
  std::vector<Eigen::Vector3d> points_;  ///< their points, in the frame of their body
  std::vector<Place> feet_;              ///< on the other surface, kept from pose to pose
  std::vector<SurfacePoint> at_feet_;    ///< the other surface there, without curvature
  std::vector<char> has_foot_;
  std::vector<Eigen::Vector3d> normals_;     ///< at the samples, in the frame of their body
  std::vector<Eigen::Matrix3d> curvatures_;  ///< curvature tensors at the samples
  std::vector<double> gap_;                  ///< of the present pose
  std::vector<double> slope_;                ///< sine of the angle between the two surfaces there
  std::vector<int> stamp_;                   ///< pose at which gap_ was computed
  std::vector<std::array<int, 8>> neighbours_;
  std::vector<int> order_;
  std::vector<Cluster> clusters_;
  std::vector<int> near_;  ///< samples below the cutoff
  int now_ = 0;
};

/// Refines two places to a local minimum of the gap at a fixed pose: Newton on g tangential = 0, h
/// = 0. False where it does not settle on an isolated minimum within `reach` [mm] of the start.
bool refine_minimum(const Surface& on_B,
                    Place& place_B,
                    const Surface& on_A,
                    Place& place_A,
                    const RigidTransform& X_BA,
                    double reach);

}  // namespace condyle
