#pragma once

/// What a sweep varies, in words and in the units that people read: degrees, mm, or a factor on a
/// load.

#include <string>

#include "scene/scene.h"

namespace condyle {

struct SweptQuantity {
  std::string title;      ///< "Flexion"
  std::string unit;       ///< "°", "mm" or "×"
  double per_inside = 1;  ///< shown value = per_inside * value inside
  bool flexion = false;
  [[nodiscard]] double shown(double inside) const { return per_inside * inside; }
  /// The title as it stands within a line: "flexion"; names of conditions stay as they are written.
  [[nodiscard]] std::string inside_a_line() const;
};
[[nodiscard]] SweptQuantity swept_quantity(const Scene& scene);

/// "60°", "2.5 mm", "1.5×".
[[nodiscard]] std::string with_unit(const SweptQuantity& quantity, double inside);

}  // namespace condyle
