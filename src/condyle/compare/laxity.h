#pragma once

/// The test of laxity that a scene's [laxity] asks for: the swept load goes over its values at each
/// angle of flexion, in the knee as it is and with some ligaments cut, by both models.

#include <optional>
#include <vector>

#include "condyle/compare/compare.h"

namespace condyle {

struct LaxityCurve {
  double flexion = 0;  ///< [rad]
  bool cut = false;
  SweepResult ours;
  std::optional<SweepResult> reference;  ///< where the scene is one that Wismans' model can hold
};

struct LaxityResult {
  std::vector<LaxityCurve>
      curves;  ///< all flexions of the knee as it is, then those of the cut one
};

/// Throws InputError for a scene without [laxity].
void check_laxity_scene(const Scene& scene);

/// Needs scene.laxity. The load is reached from none, the flexion from that of the scene, in steps.
/// `on_curve` is told of each curve. The sweeps of curve k have the numbers 2 k, ours, and 2 k + 1 for `keeping`.
[[nodiscard]] LaxityResult test_laxity(const Scene& scene,
                                       const std::vector<FittedSurface>& surfaces,
                                       const CompareOptions& options = {},
                                       const OnProgress& on_curve = {},
                                       const SweepKeeping& keeping = {});

/// Which joint coordinate (index into kJointColumns) the load acts on most in the start pose: anterior drawer for a
/// drawer force, adduction for a varus moment and for a force aside at the ankle (an arm of more than 100 mm), ...
[[nodiscard]] std::size_t loaded_coordinate(const Scene& scene);

/// That coordinate over the poses of a curve [deg or mm], from where the load is least; NaN where a
/// pose did not converge.
[[nodiscard]] std::vector<double> displacements(const Scene& scene, const SweepResult& sweep);

/// From the first to the last value of the load; NaN where one of them is missing.
[[nodiscard]] double laxity_of(const Scene& scene, const SweepResult& sweep);

/// A table: flexion, laxity intact and cut, by both models; and where a dead load acts along another coordinate.
[[nodiscard]] std::vector<std::string> laxity_lines(const Scene& scene, const LaxityResult& result);

}  // namespace condyle
