#pragma once

/// Have the two surfaces of a pair passed through each other? What lies deeper behind a surface
/// than the search for contacts looks is no overlap to it, so an open pair may have its solids
/// within each other.

#include <optional>
#include <vector>

#include "condyle/equilibrium/model.h"

namespace condyle {

class PassedThrough {
 public:
  /// `L` is the model's length, `seen` the depth to which the search for contacts takes one surface behind
  /// the other for an overlap [mm]; it is less than kDeep L where surfaces are small beside the model.
  PassedThrough(const ContactPair& pair, double L, double seen);
  PassedThrough(const ContactPair& pair, double L) : PassedThrough(pair, L, kDeep * L) {}

  /// How deep one surface lies behind the other [mm], where some of what faces the other's known part
  /// does so by more than `kDeep` L; where next to nothing faces it (a joint that slid off its edge
  /// and went on behind), some of all of both surfaces. Nothing where they are on their right
  /// sides: in a joint nothing that faces lies behind. Nothing, too, of closed surfaces: from within the
  /// solid around a hollow one a descent may come back.
  [[nodiscard]] std::optional<double> depth(const RigidTransform& X_BA) const;

  /// The same for a pose at which the search found no overlap, of what lies deeper than it sees, and of
  /// any point behind the known part of a plane or cylinder with an edge, facing it or not; sought only
  /// where no such pose is known nearby: a point that was in front of a surface cannot have passed that
  /// depth.
  [[nodiscard]] std::optional<double> depth_of_clear_pose(const RigidTransform& X_BA);

  /// For surfaces that touch somewhere, of points behind the known part of a plane or cylinder with an
  /// edge alone. Of other surfaces touching says that they are on their right sides.
  [[nodiscard]] std::optional<double> depth_of_touching_pose(const RigidTransform& X_BA);

  /// As newly made.
  void reset() { trusted_.reset(); }

  static constexpr double kDeep = 0.48;  ///< of L

 private:
  struct Sample {
    Eigen::Vector3d c, n;  ///< in its body's frame
  };
  struct Ball {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< in its body's frame
    double radius = 0;                                 ///< [mm]
  };
  [[nodiscard]] static Ball ball_about(const std::vector<Sample>& samples);
  [[nodiscard]] static bool is_in_front(const Ball& ball,
                                        const RigidTransform& X,
                                        const Surface& other,
                                        double deep);
  [[nodiscard]] std::optional<double> depth_beyond(const RigidTransform& X_BA, double deep) const;
  [[nodiscard]] std::optional<double> depth_in_solid(const RigidTransform& X_BA,
                                                     double deep,
                                                     bool beyond_edge) const;
  [[nodiscard]] bool may_be_deep(const RigidTransform& X_BA, double deep) const;
  [[nodiscard]] bool moved_far(const RigidTransform& X_BA) const;
  void trust_if_far(const RigidTransform& X_BA);

  const Surface* on_B_;
  const Surface* on_A_;
  double L_, seen_;
  bool ends_ = false;   ///< one of them has an edge,
  bool whole_ = false;  ///< which is a plane's or a cylinder's: behind it is solid
  std::vector<Sample> samples_B_, samples_A_;
  Ball ball_B_, ball_A_;                   ///< about them
  std::optional<RigidTransform> trusted_;  ///< nothing lay deep there
};

}  // namespace condyle
