#pragma once

/// How a pair of elastic layers carries, as a scene says it: plain data (layer_contact.h).

namespace condyle {

/// Pressure over depth, of one layer (layer_law.h).
enum class PressureLaw { kLinear, kLogarithmic };

struct LayerOptions {
  PressureLaw pressure = PressureLaw::kLinear;
  double tolerance = 1e-3;  ///< of the force by the lattice, relative
  double beyond = 0.05;     ///< part of the force that may face what lies beyond an edge, at most
};

/// Above this Poisson's ratio a confined layer is a rigid one: at 0.49 its modulus is 17 E, at
/// 0.499 167 E.
inline constexpr double kGreatestLayerPoisson = 0.49;

}  // namespace condyle
