#pragma once

/// What is compared: the numbers of a pose that two models of one knee have in common.

#include <functional>
#include <string>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct Quantity {
  std::string name;                             ///< "medial contact force"
  std::string units;                            ///< of the border: deg, mm, N, N mm
  std::function<double(const PoseResult&)> of;  ///< NaN where the pose does not have it
};

/// Joint coordinates but for a swept flexion, contact forces, places of contact on the tibia (in
/// its anatomical frame), ligament forces (many of them by bundles), flexion moment. Needs [joint].
/// `scene` must outlive them.
[[nodiscard]] std::vector<Quantity> compared_quantities(const Scene& scene);

/// Its values over the poses; NaN where one did not converge.
[[nodiscard]] std::vector<double> series(const Quantity& quantity, const SweepResult& sweep);

/// How far two series are from each other where both have a value.
struct Difference {
  double rms = 0, max = 0;
  std::size_t at = 0;  ///< index of the maximum
  int count = 0;       ///< of pairs
};
[[nodiscard]] Difference difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace condyle
