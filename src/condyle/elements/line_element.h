#pragma once

/// A line element from C, fixed to B, to D, fixed to A: it pulls both ends together with f(L)
/// [Dortmans 1986, 2.66-2.84]. d = a + q - x_C, q = R s, e = d/L:  F = -f(L) e on A at D, M = q x F
/// about O_A. Whichever bodies a scene names, C is the end on the fixed one.
///
/// One that is not straight has a path (line_path.h): with the wrench w = -∂L/∂(a, π) of 1 N it adds
/// f w, and f ∂w - f' w wᵀ to the derivatives.

#include <memory>
#include <string>

#include "condyle/elements/force_law.h"
#include "condyle/elements/line_path.h"
#include "condyle/elements/wrench.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct LineElement {
  Eigen::Vector3d x_C;  ///< end on the fixed body B, ground frame [mm]
  Eigen::Vector3d s_D;  ///< end on the moving body A, in A's frame [mm]
  ForceLaw law;
  std::shared_ptr<const LinePath> path = nullptr;  ///< absent: straight
};

struct LineElementState {
  double length;  ///< L [mm]
  double force;   ///< f(L) [N], tension positive
  double energy;  ///< [N mm]
};

/// Below this length [mm] the direction of the element is not defined: it then adds nothing and
/// says so by its length, and the solver reports PoseStatus::kZeroLength.
inline constexpr double kLeastLength = 1e-12;

/// Adds the element's wrench on A and its derivatives to `wrench`. Allocates nothing. `kept`: the
/// numbers of its path, null where none are kept. `roughly`: its path may be (LinePath::pull_roughly).
LineElementState add_line_element(const LineElement& element,
                                  const RigidTransform& X_BA,
                                  Wrench& wrench,
                                  double* kept = nullptr,
                                  bool roughly = false);

/// Length, force and energy only.
[[nodiscard]] LineElementState line_element_state(const LineElement& element,
                                                  const RigidTransform& X_BA,
                                                  double* kept = nullptr);

/// What speaks against the path of an element at a pose, found from nothing (LinePath::objection); empty where nothing
/// does, and for a straight one.
[[nodiscard]] std::string path_objection(const LineElement& element, const RigidTransform& X_BA);

[[nodiscard]] LineEnds ends_of(const LineElement& element, const RigidTransform& X_BA);

/// The numbers that the paths of several elements keep are one after the other; how many.
[[nodiscard]] std::size_t path_numbers(const std::vector<LineElement>& elements);

/// Hands them out, one element after the other; where there are others than so many, they become unknown.
class KeptPaths {
 public:
  KeptPaths(const std::vector<LineElement>& elements, std::vector<double>& kept);
  /// Of the next element; null for a straight one.
  double* of(const LineElement& element) {
    if (!element.path) return nullptr;
    double* kept = next_;
    next_ += element.path->numbers();
    return kept;
  }

 private:
  double* next_;
};

}  // namespace condyle
