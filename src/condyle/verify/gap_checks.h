#pragma once

/// Overlap: the lowest gap of each pair of surfaces at a pose, looked for from both sides. Those with layers
/// overlap by what their layers bear, at most.

#include <memory>
#include <vector>

#include "condyle/verify/gap_probe.h"
#include "condyle/verify/pose_checks.h"

namespace condyle::verification {

class GapCheck {
 public:
  /// `subject` must outlive it. Says in `not_checked` which contacts are let through.
  GapCheck(const Subject& subject, std::vector<std::string>& not_checked);

  void check(const PoseResult& pose, Ledger& ledger) const;

 private:
  struct Pair {
    std::size_t contact;
    PairOfSides sides;
    GapProbe from_fixed, from_moving;
    double bears;  ///< depth that layers bear [mm], 0 without
    [[nodiscard]] double may_overlap() const;
  };
  struct FoundGap {
    LowestGap lowest;
    bool on_fixed;  ///< the surface that its point is on
  };
  [[nodiscard]] static FoundGap find_lowest(const Pair& pair, const RigidTransform& X_BA);
  const Subject& subject_;
  std::vector<Pair> pairs_;
};

}  // namespace condyle::verification
