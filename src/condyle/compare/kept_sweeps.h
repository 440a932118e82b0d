#pragma once

/// A work that consists of sweeps, each known by its number: where it was stopped, another run takes
/// over what is done.

#include <functional>
#include <map>

#include "condyle/equilibrium/pose_result.h"

namespace condyle {

struct SweepKeeping {
  std::map<int, SweepResult> known;  ///< of an earlier run, taken over as they are
  std::function<void(int number, const SweepResult&)> on_computed;  ///< told of each of the others

  /// The sweep of that number: the known one, else what `compute` makes.
  template <class Compute>
  [[nodiscard]] SweepResult get(int number, const Compute& compute) const {
    if (const auto found = known.find(number); found != known.end()) return found->second;
    SweepResult sweep = compute();
    if (on_computed) on_computed(number, sweep);
    return sweep;
  }
};

}  // namespace condyle
