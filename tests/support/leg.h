#pragma once

#include "condyle/network/mass_properties.h"

namespace condyle::test {

/// Shank and foot of 4 kg, hanging along -z of the tibia.
inline MassProperties leg() {
  MassProperties mass;
  mass.mass = 4e-3;
  mass.center = {0, 0, -200};
  mass.inertia = Eigen::Vector3d(100, 100, 8).asDiagonal();
  return mass;
}

}  // namespace condyle::test
