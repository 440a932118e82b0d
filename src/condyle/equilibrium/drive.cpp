#include "condyle/equilibrium/drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace condyle {

Drive drive_of(const Model& model) {
  Drive drive;
  for (const KinematicCondition& condition : model.conditions)
    drive.values.push_back(condition.value);
  for (const Load& load : model.loads) drive.scales.push_back(load.scale);
  return drive;
}

void Swept::throw_none_such(std::size_t count) const {
  throw std::out_of_range(fmt::format("number {} is swept of the {} {} that the drive has", index,
                                      count,
                                      is_load() ? "scales of loads" : "values of conditions"));
}

void check_drive(const Drive& drive, const Model& model) {
  if (drive.values.size() == model.conditions.size() && drive.scales.size() == model.loads.size()) {
    const auto finite = [](double x) { return std::isfinite(x); };
    if (std::all_of(drive.values.begin(), drive.values.end(), finite) &&
        std::all_of(drive.scales.begin(), drive.scales.end(), finite))
      return;
    throw std::invalid_argument("the drive holds a number that is not finite");
  }
  throw std::invalid_argument(fmt::format(
      "the drive has {} values of conditions and {} scales of loads, expected {} and "
      "{} as the model has",
      drive.values.size(), drive.scales.size(), model.conditions.size(), model.loads.size()));
}

}  // namespace condyle
