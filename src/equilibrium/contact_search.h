#pragma once

/// Where two surfaces come near each other: all local minima of the gap between them at a given
/// pose.
///
/// One surface of the pair is covered with samples in a tree of clusters. Each cluster keeps the
/// osculating quadric of the other surface at the foot of its centre from the pose before; with it
/// the gap over the whole cluster is bounded from below by a quadratic model less what both
/// surfaces depart from their quadrics (bending.h). Clusters whose bound stays above the cutoff are
/// passed over, and so are those within a ball about a known contact in which the surfaces are
/// shown to be apart. Samples that are left and nearer than all their neighbours, or lead to an
/// overlap of their own by the paraboloid of the gap (gap_paraboloid.h), are refined by Newton on
/// the contact conditions at a fixed pose. No pose is trusted that this search has not
/// seen.

#include <array>
#include <memory>
#include <vector>

#include "equilibrium/bending.h"
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

/// A contact that has been solved already: gap zero, normals opposite.
struct KnownContact {
  Eigen::Vector3d on_B, on_A;  ///< the point in either body's frame [mm]
  Eigen::Matrix3d K_B, K_A;    ///< curvature tensors there, each in its body's frame [1/mm]
  double least_curvature = 0;  ///< smaller principal relative curvature [1/mm]
};

class ContactSearch {
 public:
  /// `spacing` of the samples [mm].
  explicit ContactSearch(const ContactPair& pair, double spacing = 1.2);

  /// All minima with gap < cutoff [mm], lowest first; nearer than `merge` [mm] to a lower one are
  /// left out, and so may be the known contacts.
  void find(const RigidTransform& X_BA,
            double cutoff,
            std::vector<GapMinimum>& minima,
            double merge = 0.3,
            const std::vector<KnownContact>& known = {});

  /// The same for the lowest minimum within `reach` [mm] and whatever else lies as low. Asked again
  /// at the same pose it gives the same answer without a search.
  void find_nearest(const RigidTransform& X_BA,
                    double reach,
                    std::vector<GapMinimum>& minima,
                    double merge = 0.3);

  /// False for a pair of surfaces without bounds: nothing can be searched there.
  [[nodiscard]] bool has_samples() const { return !places_.empty(); }

 private:
  /// How far beyond the known part a minimum may lie, in sample spacings.
  static constexpr double kBeyondEdge = 2;
  /// The other surface near a point, as its osculating quadric at a place that was the point's
  /// foot.
  struct Quadric {
    Place place = Place::Zero();
    SurfacePoint at = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(),
                       Eigen::Matrix<double, 3, 2>::Zero()};
    int near = -1;       ///< sample of the other surface's bending
    bool known = false;  ///< false: no foot yet
    bool close = false;  ///< the foot was found by tangent steps, so the quadric means something
  };
  struct Cluster {
    int center;       ///< a sample
    double radius;    ///< of all samples below it, about that sample [mm]
    double bend;      ///< allowance of the sampled surface within it [1/mm]
    int first, last;  ///< range in order_
    int child[2];     ///< -1: leaf
    Quadric other;
    bool split;  ///< its own bound was of no use the last time
  };
  /// A ball about a known contact in which the surfaces touch nowhere else.
  struct Disc {
    Eigen::Vector3d center;  ///< on the sampled surface, in its body's frame
    double radius;           ///< [mm]
  };
  /// The samples of a pair, and what follows from them.
  struct Cover {
    double spacing = 0;  ///< that can be afforded [mm]
    bool on_A = false;
    std::vector<Place> places;
    std::vector<SurfacePoint> points;
    double extent = 0;  ///< no two are farther apart [mm]
  };
  [[nodiscard]] static Cover cover(const Surface& on_B, const Surface& on_A, double wanted);
  ContactSearch(const ContactPair& pair, Cover cover);

  void find_within(const RigidTransform& X_BA,
                   double reach,
                   std::vector<GapMinimum>& minima,
                   double merge);
  int build(int first, int last);
  void set_discs(const std::vector<KnownContact>& known);
  [[nodiscard]] bool is_clear(Cluster& cluster, const RigidTransform& X_from_to, double cutoff);
  bool visit(int cluster, const RigidTransform& X_from_to, double cutoff);
  void scan(const Cluster& cluster, const RigidTransform& X_from_to, double cutoff);
  void find_foot(const Eigen::Vector3d& p, double close, Quadric& quadric) const;
  [[nodiscard]] static double gap_over(const Quadric& quadric, const Eigen::Vector3d& p);
  double gap_of(int sample, const RigidTransform& X_from_to);
  [[nodiscard]] double drop_within(const Cluster& cluster,
                                   const Eigen::Vector3d& tangential,
                                   const RigidTransform& X_from_to);
  [[nodiscard]] bool is_lowest_of_neighbours(int sample) const;
  [[nodiscard]] bool faces_known_part(int sample) const;
  [[nodiscard]] bool nearly_faces_known_part(int sample) const;
  [[nodiscard]] double valley_depth() const;
  [[nodiscard]] double doubt(const Quadric& quadric, double t);
  [[nodiscard]] bool leads_elsewhere(int sample, const RigidTransform& X_BA, double cutoff) const;
  void add_minimum(int sample,
                   const RigidTransform& X_BA,
                   double cutoff,
                   bool lowest,
                   std::vector<GapMinimum>& minima);
  [[nodiscard]] RigidTransform from_to(const RigidTransform& X_BA) const;
  [[nodiscard]] GapMinimum refine(int sample, const RigidTransform& X_BA) const;
  [[nodiscard]] double edge_of(const Place& on_B, const Place& on_A) const;
  [[nodiscard]] const Surface& sampled() const { return sampled_on_A_ ? *on_A_ : *on_B_; }
  [[nodiscard]] const Surface& other() const { return sampled_on_A_ ? *on_B_ : *on_A_; }

  const Surface* on_B_;
  const Surface* on_A_;
  double spacing_;
  bool lines_;  ///< the surfaces may touch along a line (line_contact.h)
  bool sampled_on_A_;
  std::vector<Place> places_;  ///< samples on the sampled surface
  double deepest_;             ///< overlap that is still taken for one [mm]
  Bending::Radii shells_;
  Bending bending_B_, bending_A_;
  double valley_;  ///< a minimum between samples lies lower than the nearest by this at most [mm]
  std::vector<Eigen::Vector3d> points_;      ///< their points, in the frame of their body
  std::vector<Eigen::Vector3d> normals_;     ///< at the samples
  std::vector<Eigen::Matrix3d> curvatures_;  ///< curvature tensors at the samples
  std::vector<Quadric> feet_;                ///< of single samples, kept from pose to pose
  std::vector<double> gap_;                  ///< of the present pose
  std::vector<int> stamp_;                   ///< pose at which gap_ was computed
  std::vector<std::array<int, 8>> neighbours_;
  std::vector<int> order_;
  std::vector<Cluster> clusters_;
  std::vector<Disc> discs_;
  int near_contact_B_ = -1, near_contact_A_ = -1;  ///< samples of the bendings
  std::vector<int> near_;                          ///< samples below the cutoff
  std::vector<Eigen::Vector3d> found_;             ///< minima, in the frame of the other body
  int now_ = 0;
  std::vector<GapMinimum> nearest_;  ///< the last answer of find_nearest, and to what
  RigidTransform nearest_X_;
  double nearest_reach_ = -1, nearest_merge_ = -1;
};

/// One search for each pair of the model.
[[nodiscard]] std::vector<ContactSearch> make_searches(const Model& model);

/// Refines two places to a local minimum of the gap at a fixed pose: Newton on g tangential = 0, h
/// = 0. False where it does not settle on an isolated minimum within `reach` [mm] of the start.
bool refine_minimum(const Surface& on_B,
                    Place& place_B,
                    const Surface& on_A,
                    Place& place_A,
                    const RigidTransform& X_BA,
                    double reach);

}  // namespace condyle
