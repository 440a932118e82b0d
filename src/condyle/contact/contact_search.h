#pragma once

/// Where two surfaces come near each other: all local minima of the gap between them at a given
/// pose.
///
/// Both surfaces of the pair are covered with samples (surface_cover.h). The samples of one hang in
/// a tree of clusters: with an osculating quadric of the other surface near a cluster the gap over
/// all of it is bounded from below, and so it is over the cell of a single sample. Clusters and
/// samples whose bound stays above the cutoff are passed over, and so are those within a ball about
/// a known contact in which the surfaces are shown to be apart (bending.h). Samples that are left
/// and nearer than all their neighbours, or lead to an overlap of their own by the paraboloid of
/// the gap (gap_paraboloid.h), are refined by Newton on the contact conditions at a fixed pose. No
/// pose is trusted that this search has not seen.

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "condyle/contact/bending.h"
#include "condyle/contact/contact_pair.h"
#include "condyle/contact/contact_scales.h"
#include "condyle/contact/gap_minimum.h"
#include "condyle/contact/nearest_sample.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

/// A contact that has been solved already: gap zero, normals opposite.
struct KnownContact {
  Eigen::Vector3d on_B, on_A;  ///< the point in either body's frame [mm]
  Eigen::Matrix3d K_B, K_A;    ///< curvature tensors there, each in its body's frame [1/mm]
  double least_curvature = 0;  ///< smaller principal relative curvature [1/mm]
};

[[nodiscard]] inline KnownContact known_contact(const ContactLinearization& at) {
  return {at.B.c, at.A.c, at.B.K, at.A.K, at.relative_curvature[0]};
}

/// What does not change of the searches of one pair, shared by all of them.
struct ContactCover {
  /// `wanted`: spacing of the samples [mm].
  ContactCover(const ContactPair& pair, double wanted);

  std::shared_ptr<const Surface> surface_B, surface_A;
  double spacing;     ///< that can be afforded [mm]
  bool sampled_on_A;  ///< the surface that takes fewer samples; one without bounds has none
  SurfaceCover on_B, on_A;
  bool lines;  ///< the surfaces may touch along a line (line_contact.h)

 private:
  struct Samples;
  ContactCover(const ContactPair& pair, Samples samples);
};

/// One for each pair.
using ContactCovers = std::vector<std::shared_ptr<const ContactCover>>;

struct Settling;

/// A search is warm: it begins where it last was, and belongs to one thread.
class ContactSearch {
 public:
  static constexpr double kDeepest = 12;  ///< [sample spacings]

  explicit ContactSearch(std::shared_ptr<const ContactCover> cover);
  /// `spacing` of the samples [mm].
  explicit ContactSearch(const ContactPair& pair, double spacing = 1.2)
      : ContactSearch(std::make_shared<const ContactCover>(pair, spacing)) {}

  /// What lies deeper behind a surface with an edge is taken for no overlap [mm].
  [[nodiscard]] double deepest() const { return kDeepest * spacing_; }

  /// What lengths of this pair are measured by [mm]: L of the model, or less where its surfaces are small for that:
  /// lever arms may be much longer.
  [[nodiscard]] double length(double L) const { return std::min(L, spacing_ / kSampleSpacing); }

  /// As newly made. Allocates nothing.
  void reset();
  /// As another search of the same cover is: begins where that one does. Allocates nothing.
  void go_back(const ContactSearch& other);

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

  /// Points of the surfaces that it looked at since it was made or copied, and what else takes the time of one.
  [[nodiscard]] long looked_at() const { return looked_at_; }

  /// False for a pair of surfaces without bounds: nothing can be searched there.
  [[nodiscard]] bool has_samples() const { return sampled().size() > 0; }

 private:
  void forget_what_was_asked();

  /// How far beyond the known part a minimum may lie, in sample spacings.
  static constexpr double kBeyondEdge = 2;
  /// Where the other surface is nearest to a point, kept from pose to pose.
  struct Closest {
    Place place = {Eigen::Vector3d::Zero()};
    SurfacePoint at = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(),
                       Eigen::Matrix<double, 3, 2>::Zero()};
    int near = -1;       ///< sample of the other surface, -1 beyond them
    int from = -1;       ///< the nearest one, from where it is looked for
    bool known = false;  ///< `place` and `at` were found, at this or an earlier pose
    bool close = false;  ///< by tangent steps, so the quadric there means something
  };
  /// A sample of the present pose.
  struct Seen {
    double gap = 0;         ///< [mm]
    double error = 0;       ///< of it
    double lower = 0;       ///< bound of the gap in its cell
    int stamp = -1;         ///< pose at which it was computed
    bool measured = false;  ///< to the closest point, not by a quadric nearby
    bool faces = false;     ///< for certain what is known of the other surface
  };
  /// Samples beside a known contact, and how far it is from them.
  struct NearContact {
    int on_B = -1, on_A = -1;
    double shift = 0;  ///< of both curvatures, with heights and slopes on the way [1/mm]
    double doubt = 0;  ///< by which a paraboloid has to be on its side [1/mm]
  };
  /// Which quadric parts the surfaces: about which known contact, from pieces of which size.
  struct Division {
    std::size_t contact = 0, size = 0;
  };
  /// A ball about a known contact in which the surfaces touch nowhere else.
  struct Disc {
    Eigen::Vector3d center;  ///< on the sampled surface, in its body's frame
    double radius;           ///< [mm]
  };

  void find_within(const RigidTransform& X_BA,
                   double reach,
                   std::vector<GapMinimum>& minima,
                   double merge);
  [[nodiscard]] bool turns_beside(const KnownContact& contact, const NearContact& near) const;
  void set_known(const std::vector<KnownContact>& known);
  [[nodiscard]] bool is_free(int level, const KnownContact& contact, const NearContact& near);
  [[nodiscard]] bool touches_only(const KnownContact& contact, const NearContact& near);
  void set_discs(const std::vector<KnownContact>& known);
  void look(const RigidTransform& X_from_to, double cutoff, const std::vector<KnownContact>& known);
  [[nodiscard]] bool is_clear_of_sample(const SurfaceCover::Cluster& cluster,
                                        const Eigen::Vector3d& p,
                                        double cutoff,
                                        int near) const;
  [[nodiscard]] bool is_clear_of_closest(const SurfaceCell& cluster,
                                         const RigidTransform& X_from_to,
                                         double cutoff,
                                         Closest& closest);
  [[nodiscard]] bool is_clear(int cluster, const RigidTransform& X_from_to, double cutoff);
  [[nodiscard]] bool in_disc(const SurfaceCover::Cluster& cluster) const;
  bool look_beside(const RigidTransform& X_from_to, double cutoff);
  bool part(const Division& division,
            const RigidTransform& X_from_to,
            std::vector<int>& doubtful,
            std::vector<int>& doubtful_other);
  void part_best(const RigidTransform& X_from_to);
  void look_at_facing(int sample_of_other,
                      int& near,
                      const RigidTransform& X_from_to,
                      double cutoff);
  void look_at(int sample, int& near, const RigidTransform& X_from_to, double cutoff);
  bool visit(int cluster, const RigidTransform& X_from_to, double cutoff);
  void estimate(int sample, int& near, const RigidTransform& X_from_to, double cutoff);
  void measure(int sample, const RigidTransform& X_from_to);
  void gather_lowest(const RigidTransform& X_from_to);
  [[nodiscard]] bool is_beside(const Eigen::Vector3d& p, double r, const Closest& closest) const;
  [[nodiscard]] Facing face_closest(const Eigen::Vector3d& p, double r, Closest& closest);
  bool faces_known_part(const Eigen::Vector3d& p, double r, Closest& closest, Facing& facing);
  void find_closest(const Eigen::Vector3d& p, double close, Closest& closest);
  [[nodiscard]] double height_over(int sample, int neighbour) const;
  [[nodiscard]] bool is_lowest_of_neighbours(int sample) const;
  [[nodiscard]] bool is_lowest(int sample, const RigidTransform& X_from_to);
  [[nodiscard]] int deepest_unexplained(double cutoff, const std::vector<GapMinimum>& minima) const;
  [[nodiscard]] bool nearly_faces_known_part(int sample) const;
  [[nodiscard]] bool leads_elsewhere(int sample, const RigidTransform& X_BA, double cutoff) const;
  void add_rims(const RigidTransform& X_BA, double cutoff, std::vector<GapMinimum>& minima);
  void add_rim(int sample,
               bool of_A,
               const RigidTransform& X_BA,
               double cutoff,
               std::vector<GapMinimum>& minima);
  void add_minimum(int sample,
                   const RigidTransform& X_BA,
                   double cutoff,
                   bool lowest,
                   std::vector<GapMinimum>& minima);
  [[nodiscard]] RigidTransform from_to(const RigidTransform& X_BA) const;
  [[nodiscard]] GapMinimum gap_at(ContactPlaces places, const RigidTransform& X_BA) const;
  /// Nothing where the minimum near the sample lies above the cutoff.
  [[nodiscard]] std::optional<GapMinimum> refine(int sample,
                                                 const RigidTransform& X_BA,
                                                 double cutoff,
                                                 bool lowest);
  [[nodiscard]] std::optional<GapMinimum> downhill_from(const ContactPlaces& start,
                                                        const RigidTransform& X_BA,
                                                        const Settling& how);
  [[nodiscard]] SurfacePair surfaces() const { return {*cover_->surface_B, *cover_->surface_A}; }
  [[nodiscard]] const SurfaceCover& sampled() const {
    return sampled_on_A_ ? cover_->on_A : cover_->on_B;
  }
  [[nodiscard]] const SurfaceCover& other() const {
    return sampled_on_A_ ? cover_->on_B : cover_->on_A;
  }
  [[nodiscard]] NearestSample& nearest_of_sampled() {
    return sampled_on_A_ ? nearest_A_ : nearest_B_;
  }
  [[nodiscard]] NearestSample& nearest_of_other() {
    return sampled_on_A_ ? nearest_B_ : nearest_A_;
  }
  [[nodiscard]] Bending& bending_sampled() { return sampled_on_A_ ? bending_A_ : bending_B_; }
  [[nodiscard]] Bending& bending_other() { return sampled_on_A_ ? bending_B_ : bending_A_; }
  [[nodiscard]] Seen& seen(int sample) { return seen_[static_cast<std::size_t>(sample)]; }
  [[nodiscard]] const Seen& seen(int sample) const {
    return seen_[static_cast<std::size_t>(sample)];
  }
  [[nodiscard]] Closest& closest(int sample) { return closest_[static_cast<std::size_t>(sample)]; }
  [[nodiscard]] const Closest& closest(int sample) const {
    return closest_[static_cast<std::size_t>(sample)];
  }

  std::shared_ptr<const ContactCover> cover_;
  double spacing_;
  bool sampled_on_A_;
  double deepest_;  ///< overlap that is still taken for one [mm]
  Bending::Radii shells_;
  Bending bending_B_, bending_A_;
  NearestSample nearest_B_, nearest_A_;
  std::vector<Closest> closest_;          ///< to each sample
  std::vector<Closest> cluster_closest_;  ///< to the centre of each cluster
  std::vector<char> split_;               ///< the cluster's own bound was of no use the last time
  std::vector<Seen> seen_;
  std::vector<Disc> discs_;
  std::vector<NearContact> near_contacts_;      ///< of those known now, and more
  std::size_t known_ = 0;                       ///< of these
  Division division_;                           ///< that left the fewest doubts when all were tried
  std::size_t doubts_ = 0;                      ///< that it left then
  std::vector<int> near_;                       ///< samples whose cell may reach the cutoff
  std::vector<Eigen::Vector3d> found_;          ///< minima, in the frame of the other body
  std::vector<int> lowest_;                     ///< of these, lower than all neighbours
  std::vector<int> doubtful_, doubtful_other_;  ///< samples not on their side of a quadric,
  std::vector<int> doubtful_there_, doubtful_other_there_;  ///< and of another one
  int now_ = 0;
  long looked_at_ = 0;
  std::vector<GapMinimum> nearest_;  ///< the last answer of find_nearest, and to what
  RigidTransform nearest_X_;
  double nearest_reach_ = -1, nearest_merge_ = -1;
};

/// ContactSearch::looked_at of all of them.
[[nodiscard]] long points_looked_at(const std::vector<ContactSearch>& searches);

/// How low the gap may be [mm] in a cell of radius r [mm] about a point, in a frame turned by R,
/// that faces the other surface like that and whose curvature changes by `bend` [1/mm]. Above the
/// cutoff by the way alone it is not sought closer.
[[nodiscard]] double bound_of_cell(const Facing& facing,
                                   const SurfacePoint& own,
                                   const Eigen::Matrix3d& R,
                                   double r,
                                   double bend,
                                   double cutoff);

}  // namespace condyle
