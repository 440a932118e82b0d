#pragma once

/// What goes from pose to pose of a study: how the scene names it, how people read it, and in which
/// units. The one place that knows; of a run ask results/run_view.h, which knows its kind.

#include <string>

#include "condyle/scene/scene.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

struct SweptQuantity {
  std::string name = "value";   ///< as the scene writes it: "flexion", "drawer.scale"; "time"
  std::string title = "Pose";   ///< for people: "Flexion", "Factor on drawer"
  std::string inside = "pose";  ///< the title within a line: "flexion"
  std::string symbol = {};      ///< of the unit, for people: "°", "mm", "s" or "×"
  Unit unit = {"1", 1};         ///< of result files and tables: deg, mm, s or 1
  Unit declared = {"1", 1};     ///< of the scene: rad, cm ...
  int condition = -1;           ///< whose value it is
  int load = -1;                ///< whose factor it is
  bool flexion = false;
  /// As the abscissa of a chart: a factor on a load stands for the size of that load.
  std::string axis = "Pose";  ///< with unit: "Flexion [°]", "drawer [N]"
  double axis_per_inside = 1;

  [[nodiscard]] double shown(double value) const { return in_unit(value, unit); }
  [[nodiscard]] std::string unit_after_number() const;  ///< " deg"; nothing where it is 1
  [[nodiscard]] std::string heading() const;            ///< "flexion [deg]", "drawer.scale"
};

/// What the [sweep] of a scene varies; nothing where it has none.
[[nodiscard]] SweptQuantity quantity_of_sweep(const Scene& scene);
/// What goes from frame to frame of a motion.
[[nodiscard]] SweptQuantity quantity_of_motion();

/// What is wrong with the values of a scene's sweep: angles beyond one turn, distances that are none. Empty: nothing.
[[nodiscard]] std::string fault_of_values(const Scene& scene);

/// "60°", "2.5 mm", "1.5×".
[[nodiscard]] std::string with_unit(const SweptQuantity& quantity, double value);

}  // namespace condyle
