#pragma once

/// The tibia of the phantom before it is sized; see docs/phantom.md for the sources of its measures.
/// Lengths in mm.

#include <cmath>

#include "phantom/phantom_parameters.h"
#include "phantom/smooth.h"

namespace condyle::phantom {

template <class T>
T plateau_height(const Plateau& p, const T& x, const T& z) {
  const T along = x - p.x;
  return p.height + p.slope * along + dish<T>(along, p.sagittal, 24) +
         dish<T>(z - p.z, p.coronal, 14);
}

/// Both plateaus, the two spines of the eminence and the hollows in front of and behind it.
template <class T>
T tibial_height(const TibiaParameters& tibia, const T& x, const T& z) {
  const T lateral = step<T>(z, 2.6);
  const T plateaus = (1.0 - lateral) * plateau_height(tibia.medial, x, z) +
                     lateral * plateau_height(tibia.lateral, x, z);
  const T spines =
      5.5 * hill<T>(x - 0.5, 9.0, z + 5.5, 3.2) + 5.5 * hill<T>(x + 1.5, 8.0, z - 5.5, 3.2);
  const T hollows = 4.0 * hill<T>(x - 17.0, 6.0, z, 6.0) + 7.0 * hill<T>(x + 18.0, 7.0, z, 6.0);
  return plateaus + spines - hollows;
}

/// An upright elliptic column that narrows below the plateau.
template <class T>
T column(const T& x, const T& taper, const T& z, double depth, double width) {
  using std::sqrt;
  const T section = sqrt(square(x / (depth * taper)) + square(z / (width * taper)) + 1e-4);
  return (section - 1.0) * (0.5 * (depth + width)) * taper;
}

template <class T>
T tibia_shape(const TibiaParameters& tibia, const T& x, const T& y, const T& z) {
  const T taper = 1.0 - 0.62 * step<T>(-46.0 - y, 7.0);
  const T medial = column<T>(x - 3.0, taper, z + 15.5 * taper, 25.5, 23.0);
  const T lateral = column<T>(x - 3.0, taper, z - 16.5 * taper, 22.5, 21.5);
  const T front = column<T>(x - 9.0, taper, z, 19.5, 20.0);
  const T shaft = column<T>(x - 5.5, T(1.0), z, 14.5, 12.0);
  const T tuberosity = ellipsoid<T>(x - 17.0, y + 47.0, z - 2.0, 10.5, 17, 9);
  const T fibular_head = ellipsoid<T>(x + 13.0, y + 44.0, z - 27.0, 8.5, 13, 8.5);
  const T sides = smooth_min<T>({medial, lateral, front, shaft, tuberosity, fibular_head}, 2.2);
  return smooth_max<T>({y - tibial_height(tibia, x, z), sides, -108.0 - y}, 1.6);
}

}  // namespace condyle::phantom
