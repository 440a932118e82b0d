#pragma once

/// The femur of the phantom before it is sized; see docs/phantom.md for the sources of its measures.
/// Lengths in mm, angles in rad.

#include <cmath>

#include "phantom/phantom_parameters.h"
#include "phantom/smooth.h"

namespace condyle::phantom {

/// Distance from the centre of the posterior arc to the outline in the direction `angle` (from
/// distal, towards posterior). With Δ the difference of the radii, the distal arc lies at √(r² - Δ²
/// sin²s) - Δ cos s, s the angle past the turn; letting s rise smoothly from 0 turns one arc into
/// the other. In front, where the trochlea takes over, s falls back to 0, which closes the outline.
template <class T>
T outline_radius(const Condyle& c, const T& angle) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const double delta = c.distal - c.posterior, w = c.passage;
  const T past = c.turn - angle;
  const T s = ramp(past, w) - ramp(past - 85 * kDegree, w) - ramp(past - 92 * kDegree, w) +
              ramp(past - 177 * kDegree, w);
  return sqrt(c.distal * c.distal - delta * delta * square(sin(s))) - delta * cos(s);
}

template <class T>
T condyle_shape(const Condyle& c, const T& x, const T& y, const T& z) {
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  // The angle's jump is turned to 190°, into the middle of the bone.
  const double cut = 10 * kDegree;
  const T xr = std::cos(cut) * x - std::sin(cut) * y, yr = std::sin(cut) * x + std::cos(cut) * y;
  const T angle = atan2(0.0 - xr, 0.0 - yr) + cut;
  const T radius = sqrt(square(x) + square(y) + 1e-4);
  const T core = radius - outline_radius(c, angle) + c.coronal;
  const T across = z - c.z - c.drift * x;
  const T tube = sqrt(square(core) + square(across) + 1e-4) - c.coronal;
  const double side = c.wall < 0 ? -1 : 1;
  return smooth_max<T>({tube, side * z - side * c.wall}, 1.6);
}

/// A drum about the axis x = 15, y = 8.5 with a rounded groove.
template <class T>
T trochlea_shape(const T& x, const T& y, const T& z) {
  using std::sqrt;
  const T across = z - 1.5;
  const T groove = 0.40 * (sqrt(square(across) + 16.0) - 4.0);
  const T rim = 7.0 * square(square(across / 23.0));
  const T radius = sqrt(square(x - 15.0) + square(y - 8.5) + 1e-4);
  return 0.9 * (radius - (22.0 + groove + 0.06 * across - rim));
}

/// Shaft and its flare towards the condyles.
template <class T>
T femoral_shaft_shape(const T& x, const T& y, const T& z) {
  using std::sqrt;
  const T flare = step(24.0 - y, 8.0), flare_front = step(22.0 - y, 9.0);
  const T width = 14.0 + 21.5 * flare, depth = 13.2 + 5.3 * flare_front;
  const T across = z / width, along = (x - 14.5 + 2.5 * flare_front) / depth;
  const T section = (sqrt(square(across) + square(along) + 1e-4) - 1.0) * 14.0;
  return smooth_max<T>({section, 1.0 - y, y - 68.0}, 2.0);
}

/// The space between the condyles: two walls and a roof that climbs backwards.
template <class T>
T notch_shape(const T& x, const T& y, const T& z) {
  const double slope = 0.9;
  const T roof = (y - 2.5 + slope * (x - 2.0)) * (1 / std::sqrt(1 + slope * slope));
  return smooth_max<T>({roof, z - 8.5, -8.5 - z}, 2.5);
}

template <class T>
T femur_shape(const FemurParameters& femur, const T& x, const T& y, const T& z) {
  const T medial_epicondyle = ellipsoid<T>(x - 2.0, y - 6.0, z + 29.0, 13, 14, 10.5);
  const T lateral_epicondyle = ellipsoid<T>(x - 1.0, y - 5.0, z - 29.0, 12, 12, 9.5);
  const T articular =
      smooth_min<T>({condyle_shape(femur.medial, x, y, z), condyle_shape(femur.lateral, x, y, z),
                     trochlea_shape(x, y, z)},
                    1.4);
  const T solid = smooth_min<T>(
      {articular, femoral_shaft_shape(x, y, z), medial_epicondyle, lateral_epicondyle}, 2.4);
  return smooth_max<T>({solid, 0.0 - notch_shape(x, y, z)}, 1.5);
}

}  // namespace condyle::phantom
