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

  /// The same for a pose at which the search found no overlap, of what lies deeper than it sees; sought only
  /// where no such pose is known nearby: a point that was in front of a surface cannot have passed that
  /// depth.
  [[nodiscard]] std::optional<double> depth_of_clear_pose(const RigidTransform& X_BA);

  /// The surfaces touch here: they are on their right sides.
  void trust(const RigidTransform& X_BA) { trusted_ = X_BA; }

  /// As newly made.
  void reset() { trusted_.reset(); }

  static constexpr double kDeep = 0.48;  ///< of L

 private:
  struct Sample {
    Eigen::Vector3d c, n;  ///< in its body's frame
  };
  [[nodiscard]] std::optional<double> depth_beyond(const RigidTransform& X_BA, double deep) const;
  [[nodiscard]] bool may_be_deep(const RigidTransform& X_BA, double deep) const;
  [[nodiscard]] bool moved_far(const RigidTransform& X_BA) const;

  const Surface* on_B_;
  const Surface* on_A_;
  double L_, seen_;
  bool ends_ = false;  ///< one of them has an edge
  std::vector<Sample> samples_B_, samples_A_;
  std::optional<RigidTransform> trusted_;
};

}  // namespace condyle
