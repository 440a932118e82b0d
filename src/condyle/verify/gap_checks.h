#pragma once

/// Overlap: the lowest gap of each pair of surfaces at a pose, looked for from both sides.

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
  };
  const Subject& subject_;
  std::vector<Pair> pairs_;
};

}  // namespace condyle::verification
