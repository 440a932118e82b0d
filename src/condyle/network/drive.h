#pragma once

/// The course of loads in time.

#include <vector>

#include "condyle/scene/scene.h"

namespace condyle {

/// The factor on a load at time t [s]: the sum of its drives, or `otherwise` where it has none.
[[nodiscard]] double load_scale_at(const std::vector<DriveDescription>& drives,
                                   int load,
                                   double t,
                                   double otherwise = 1);

/// Where pulses begin and end, sines begin, and tables have corners [s].
[[nodiscard]] std::vector<double> drive_breaks(const std::vector<DriveDescription>& drives);

}  // namespace condyle
