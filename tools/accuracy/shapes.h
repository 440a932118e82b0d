#pragma once

/// Shapes that are known exactly, as data for a fit: sheets of an ellipsoid and of a torus, and the
/// articular surfaces of the phantom.

#include <functional>
#include <string>
#include <vector>

#include "condyle/surface/fit_patch.h"

namespace condyle::accuracy {

/// Root mean squares, away from the edge.
struct FitErrors {
  double position = 0;   ///< [mm]
  double normal = 0;     ///< [degrees]
  double curvature = 0;  ///< of the tensor, per root of two principal values [1/mm]
};

struct Shape {
  std::string name;
  bool smooth;  ///< bends over lengths much longer than the knots
  ArticularRegion exact, noisy;
  std::function<FitErrors(const Patch&)> errors;
};

/// `noise` [mm] of every vertex alone, along the normal (sheets: upwards).
[[nodiscard]] std::vector<Shape> shapes(double noise);

}  // namespace condyle::accuracy
