#pragma once

/// What drives a model from pose to pose: the numbers that are arguments of a pose while the model
/// itself stays constant. Drive and state (newton.h) are those of one moving body, as the model has
/// one.

#include <cstddef>
#include <vector>

#include "condyle/equilibrium/model.h"

namespace condyle {

struct Drive {
  std::vector<double> values;  ///< of the conditions [rad] or [mm]
  std::vector<double> scales;  ///< of the loads

  friend bool operator==(const Drive&, const Drive&) = default;
};

/// The model's nominal values: KinematicCondition::value and Load::scale.
[[nodiscard]] Drive drive_of(const Model& model);

/// Throws std::invalid_argument with one sentence where the drive is not one of the model, or not finite.
void check_drive(const Drive& drive, const Model& model);

/// Which number of a drive is swept.
struct Swept {
  enum class Kind { kCondition, kLoad };
  Kind kind = Kind::kCondition;
  std::size_t index = 0;  ///< of Model::conditions or Model::loads

  [[nodiscard]] bool is_load() const { return kind == Kind::kLoad; }
  /// Throw std::out_of_range with one sentence for a number that the drive has not.
  [[nodiscard]] double& in(Drive& drive) const {
    std::vector<double>& numbers = is_load() ? drive.scales : drive.values;
    if (index >= numbers.size()) throw_none_such(numbers.size());
    return numbers[index];
  }
  [[nodiscard]] double in(const Drive& drive) const {
    const std::vector<double>& numbers = is_load() ? drive.scales : drive.values;
    if (index >= numbers.size()) throw_none_such(numbers.size());
    return numbers[index];
  }
  [[noreturn]] void throw_none_such(std::size_t count) const;
  [[nodiscard]] Drive with(Drive drive, double value) const {
    in(drive) = value;
    return drive;
  }
};

/// The value of a condition, or the scale of a load.
[[nodiscard]] constexpr Swept condition_value(std::size_t index) {
  return {Swept::Kind::kCondition, index};
}
[[nodiscard]] constexpr Swept load_scale(std::size_t index) { return {Swept::Kind::kLoad, index}; }

}  // namespace condyle
