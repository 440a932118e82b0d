#pragma once

/// Units at the border, and the values that a range visits.

#include <string>
#include <vector>

namespace condyle {

struct Unit {
  std::string name;   ///< "deg", "mm", "1" ...
  double factor = 1;  ///< to the unit used inside
};

/// A value that is used inside, in a unit: as a user wrote it, where it came from that unit (15 and
/// not 14.999999999999998: the conversions to and fro may cost the last digit).
[[nodiscard]] double in_unit(double inside, const Unit& unit);

/// from, from + step, ... up to `to`, which is met where it is a whole number of steps away. Throws
/// InputError ("step = -5, expected ...") for a range that leads nowhere, or holds more than a
/// million values or values nearer to each other than 1e-10 of the greatest, or of 1.
[[nodiscard]] std::vector<double> range_values(double from, double to, double step);

}  // namespace condyle
