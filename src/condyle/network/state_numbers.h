#pragma once

/// The state of a network as the numbers that are integrated in time: of each body the reference
/// port, the unit quaternion and the twist; then what was dissipated and what the drivers gave.

#include <vector>

#include "condyle/network/network_equations.h"

namespace condyle {

class StateNumbers {
 public:
  /// Keeps a reference.
  explicit StateNumbers(const Network& network) : network_(network) {}

  [[nodiscard]] std::size_t size() const;
  /// For a tolerance of one: what counts as one [mm, rad, mm/s, rad/s, N mm]; 10 mm on a knee of
  /// L = 30 mm.
  [[nodiscard]] std::vector<double> scales() const;

  void pack(const NetworkState& state, double dissipated, double work, double* y) const;
  /// Poses and twists; the quaternion need not be a unit.
  void unpack(const double* y, NetworkState& state) const;
  [[nodiscard]] double dissipated(const double* y) const { return y[size() - 2]; }
  [[nodiscard]] double work(const double* y) const { return y[size() - 1]; }

  /// dy/dt after solve() at the same numbers.
  void rates(const double* y, const NetworkEquations& equations, double* rate) const;
  /// y' - y where y' are the numbers of the state.
  void difference(const NetworkState& state, const double* y, double* change) const;
  /// Of an error of y what stays where the constraints are kept, by the rows last assembled.
  void keep_admissible(const double* y, const NetworkEquations& equations, double* error) const;

 private:
  const Network& network_;
};

}  // namespace condyle
