#pragma once

/// Where the next pose of a sweep will be, from up to five before it: the pose, the places of
/// contact, forces and multipliers extrapolated by a polynomial in what drives them. Newton then
/// needs two or three iterations in place of four.

#include <array>
#include <vector>

#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/newton.h"

namespace condyle {

class Predictor {
 public:
  explicit Predictor(const Model& model) : model_(model) {}

  void clear() { count_ = 0; }

  /// A solved state; those before count only while the closed contacts are the same pairs.
  void add(const Drive& drive, const EquilibriumState& state);

  /// Writes an estimate for `drive` into `state`; false where the states so far do not lead there:
  /// too few, not on one line, or too short a way for so long a step. Allocates nothing once
  /// `state` has its size.
  [[nodiscard]] bool predict(const Drive& drive, EquilibriumState& state);

 private:
  struct Known {
    Drive drive;
    EquilibriumState state;
  };
  static constexpr int kMost = 5;
  using Weights = std::array<double, kMost>;  ///< of the known states, the newest first

  [[nodiscard]] const Known& known(int back) const {
    return history_[static_cast<std::size_t>((newest_ - back + kMost) % kMost)];
  }
  [[nodiscard]] bool position(const Drive& target, int back, double& t) const;
  void extrapolate(const Weights& weight, int points, EquilibriumState& state) const;

  const Model& model_;
  std::array<Known, kMost> history_;
  int count_ = 0, newest_ = 0;
};

}  // namespace condyle
