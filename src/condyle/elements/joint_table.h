#pragma once

/// The six joint coordinates by their names, in their order: one table for files, tables and
/// charts.

#include <array>

#include "condyle/elements/joint_coordinates.h"

namespace condyle {

struct JointCoordinate {
  const char* name;    ///< in files
  const char* words;   ///< for people
  const char* column;  ///< at the head of a narrow column
  bool angle;          ///< [rad], else a length [mm]
  double JointCoordinates::*member;
};

inline constexpr std::array<JointCoordinate, 6> kJointCoordinates = {{
    {"flexion", "flexion", "flex", true, &JointCoordinates::flexion},
    {"adduction", "adduction", "adduct", true, &JointCoordinates::adduction},
    {"internal_rotation", "internal rotation", "int.rot", true,
     &JointCoordinates::internal_rotation},
    {"lateral_shift", "lateral shift", "lat.sh", false, &JointCoordinates::lateral_shift},
    {"anterior_drawer", "anterior drawer", "ant.dr", false, &JointCoordinates::anterior_drawer},
    {"distraction", "distraction", "distr", false, &JointCoordinates::distraction},
}};

}  // namespace condyle
