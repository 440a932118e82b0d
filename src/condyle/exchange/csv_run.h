#pragma once

/// A run as one tidy table: a row for each number.
///
///     pose,swept,swept_unit,quantity,name,component,value,unit
///     0,0,deg,ligament,aACL,force,133.2,N

#include <string>
#include <vector>

#include "condyle/exchange/shown_poses.h"

namespace condyle {

/// Numbers with the fewest digits that give back the same bits; what a pose does not have gets no
/// row.
[[nodiscard]] std::string csv_of_poses(const Run& run, const std::vector<ShownPose>& shown);

}  // namespace condyle
