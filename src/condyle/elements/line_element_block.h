#pragma once

/// The line elements of a model as the solver's inner loop wants them: the sum of what
/// add_line_element (line_element.h) does for each, in a fraction of the time.

#include <vector>

#include "condyle/elements/line_element.h"

namespace condyle {

class LineElementBlock {
 public:
  /// Keeps a reference: `elements` must stay as they are until they are set anew.
  explicit LineElementBlock(const std::vector<LineElement>& elements) { set(elements); }
  /// Allocates nothing for as many as before.
  void set(const std::vector<LineElement>& elements);

  struct Summary {
    double force_magnitudes = 0;  ///< Σ |f| [N]
    int zero_element = -1;        ///< the last element of zero length, or -1
  };
  /// Adds the wrench of all elements on A and its derivatives. Allocates nothing.
  Summary add_to(const RigidTransform& X_BA, Wrench& wrench) const;

 private:
  struct Entry {
    double x_C[4], s_D[4];
    double stiffness, inverse_slack, transition_strain;  ///< toe-linear; a general law has slack 0
    const ForceLaw* law;                                 ///< of another kind, else null
  };
  struct Sums;
  static void add_entries(const std::vector<Entry>& entries,
                          const RigidTransform& X_BA,
                          Sums& sums);

  std::vector<Entry> entries_;
};

}  // namespace condyle
