#pragma once

/// Units at the border, and the values that a range visits.

#include <string>
#include <vector>

namespace condyle {

struct Unit {
  std::string name;   ///< "deg", "mm", "1" ...
  double factor = 1;  ///< to the unit used inside
};

/// from, to and step as they were written, in the scene's own unit.
struct WrittenRange {
  double from = 0, to = 0, step = 1;
};

/// A value that is used inside, in a unit: as a user wrote it, where it came from that unit (15 and
/// not 14.999999999999998: the conversions to and fro may cost the last digit).
[[nodiscard]] double in_unit(double inside, const Unit& unit);

/// from, from + step, ... up to `to`, which is met where it is a whole number of steps away. Throws
/// InputError ("step = -5, expected ...") for a range that leads nowhere, or holds more than a
/// million values or values nearer to each other than 1e-10 of the greatest, or of 1.
[[nodiscard]] std::vector<double> range_values(const WrittenRange& range);

}  // namespace condyle
