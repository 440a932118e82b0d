#pragma once

/// A run as columns of numbers with names and units, for tables of any kind. Angles in deg, lengths
/// in mm, forces in N; everything that is a vector is in the ground frame.

#include <string>
#include <vector>

#include "condyle/exchange/shown_poses.h"

namespace condyle {

/// How each table of a run in CSV begins.
inline constexpr const char* kTableHead = "pose,swept,swept_unit,";

struct TableColumn {
  std::string quantity;   ///< pose, joint, contact, ligament, condition, sensitivity, solver
  std::string name;       ///< of the body, contact, ligament or condition
  std::string component;  ///< "force", "point_x" ...
  std::string unit;
  std::vector<double> values;  ///< one for each pose; NaN where there is none
};

[[nodiscard]] std::vector<TableColumn> run_columns(const Run& run,
                                                   const std::vector<ShownPose>& shown);

}  // namespace condyle
