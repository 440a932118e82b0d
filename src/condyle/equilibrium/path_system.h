#pragma once

/// Newton's system with the swept value as one more unknown, and one more row that says how far to
/// go along the path of equilibria: regular at limit points, where the path turns back.
///
/// The length of the path counts the motion of the body (da, L dπ) and the swept value, scaled so
/// that the whole range counts as L; contact forces and multipliers do not count.

#include <array>

#include "condyle/equilibrium/linearization.h"

namespace condyle {

/// A point of the path.
struct PathPoint {
  EquilibriumState state;
  double value = 0;
};

class PathSystem {
 public:
  /// Components (da, L dπ, dp, dσ/w, dλ); only the first `size` count.
  struct Direction {
    std::array<double, SmallLu::kMaxSize> d{};
    int size = 0;
    [[nodiscard]] double value() const { return d[static_cast<std::size_t>(size - 1)]; }
    [[nodiscard]] double force(std::size_t contact) const { return d[6 + contact]; }
  };

  /// `drive`: of all that is not swept; `range`: of the swept value, counts as L. Throws
  /// std::invalid_argument for a drive that is not one of the model, std::out_of_range for a number
  /// that it has not.
  PathSystem(const Model& model, const Swept& swept, const Drive& drive, double range);

  void set_parameters(const Parameters& parameters) { system_.set_parameters(parameters); }

  /// The unit tangent of the path at a point on it, of either sign; false where there is none or
  /// more than one.
  bool tangent(const PathPoint& at, Direction& tangent);

  /// Newton back to the path, at right angles to `tangent`; with the swept value held where
  /// `hold_value`. Ligaments lie on what they wrap on there (LinePath::revise).
  bool correct(PathPoint& point, const Direction& tangent, bool hold_value = false);

  /// The point that lies `length` along a direction [mm].
  [[nodiscard]] PathPoint ahead(const PathPoint& from, const Direction& direction, double length);

  /// How fast a gap that is no contact opens along a direction.
  [[nodiscard]] double gap_rate(const ContactLinearization& contact,
                                const Direction& direction) const;

  /// Of two directions, in the measure of the path's length; their constraints may differ.
  [[nodiscard]] double product(const Direction& a, const Direction& b) const;

  /// How far one point lies from another, straight, in the same measure [mm].
  [[nodiscard]] double distance(const PathPoint& a, const PathPoint& b) const;

  /// Lets ligaments lie as they would at a point, on the path or off it; false where none lies otherwise.
  bool revise(PathPoint& point) { return assemble(point) && system_.revise(point.state); }

  /// False where an element has no length.
  bool assemble(const PathPoint& point);
  /// At the point that was assembled last, and must stay.
  [[nodiscard]] Linearization linearization(const PathPoint& point) const {
    return condyle::linearization(system_, point.state, drive_);
  }

 private:
  int fill(const PathPoint& point, double* right_side);
  void apply(PathPoint& point, const double* step) const;

  const Model& model_;
  Swept swept_;
  Drive drive_;
  double weight_;  ///< of the swept value in the length of the path [mm per unit]
  NewtonSystem system_;
  SmallLu matrix_;
};

}  // namespace condyle
