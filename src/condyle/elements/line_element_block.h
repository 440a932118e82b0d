#pragma once

/// The line elements of a model as the solver's inner loop wants them: the sum of what
/// add_line_element (line_element.h) does for each, in a fraction of the time. Those with a path of
/// their own come after the straight ones, one by one.

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
  /// Adds the wrench of all elements on A and its derivatives. Allocates nothing. The paths start
  /// from the numbers `kept` where those are as many as path_numbers(elements), else from unknown
  /// ones; paths() are the numbers at this pose, of paths that are found `roughly` (LinePath::pull_roughly)
  /// nearly.
  Summary add_to(const RigidTransform& X_BA,
                 const std::vector<double>& kept,
                 Wrench& wrench,
                 bool roughly = false);

  [[nodiscard]] bool has_paths() const { return !curved_.empty(); }
  [[nodiscard]] const std::vector<double>& paths() const { return paths_; }
  /// At a pose that has been solved, that of the last add_to: does any path change what it holds
  /// (LinePath::revise)?
  bool revise_paths(const RigidTransform& X_BA);

 private:
  struct Entry {
    double x_C[4], s_D[4];
    double stiffness, inverse_slack, transition_strain;  ///< toe-linear; a general law has slack 0
    const ForceLaw* law;                                 ///< of another kind, else null
  };
  /// An element with a path, and where the numbers of that begin.
  struct Curved {
    const LineElement* element;
    int index;
    std::size_t numbers;
    bool passed_over = false;  ///< the last add_to knew that it is slack, and did not follow it
  };
  struct Sums;
  static void add_entries(const std::vector<Entry>& entries,
                          const RigidTransform& X_BA,
                          Sums& sums);
  void add_curved(const RigidTransform& X_BA,
                  const std::vector<double>& kept,
                  bool roughly,
                  Wrench& wrench,
                  Summary& summary);

  std::vector<Entry> entries_;
  std::vector<int> straight_;  ///< which element an entry is, where some are not
  std::vector<Curved> curved_;
  std::vector<double> paths_;
};

}  // namespace condyle
