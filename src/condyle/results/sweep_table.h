#pragma once

/// A sweep as lines of text: one row for each pose, a closing summary, and what went wrong where.
/// Angles in deg, lengths in mm, forces in N, times in µs.

#include <string>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/scene/ligament_bundles.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {

class SweepTable {
 public:
  /// `values`: those to come, in units used inside, which are told with as many decimals as tell them apart.
  SweepTable(const Scene& scene,
             const SweptQuantity& swept,
             const std::vector<double>& values = {});
  /// Two lines: names and units.
  [[nodiscard]] std::string head() const;
  [[nodiscard]] std::string row(const PoseResult& pose) const;

 private:
  struct Cell {
    std::string name, units;
    int decimals;
    double (*value)(const SweepTable& table, const PoseResult& pose, std::size_t index);
    std::size_t index = 0;
  };
  void add_coordinates(bool joint, bool flexion_is_swept);
  [[nodiscard]] static int width(const Cell& cell);

  Unit unit_;  ///< of the swept values
  std::vector<LigamentBundle> ligaments_;
  std::vector<Cell> cells_;
};

/// "25 of 25 poses converged, largest residual 1.2e-11 N, largest gap 3e-14 mm, 1.3 ms (52 µs a
/// pose) and 0.4 ms for events"
[[nodiscard]] std::string summary(const SweepResult& sweep);

/// One line for each event: "lateral: opening at 93.271845 deg", "limit point at 12.5 deg".
[[nodiscard]] std::vector<std::string> event_lines(const Scene& scene,
                                                   const SweptQuantity& swept,
                                                   const SweepResult& sweep);

/// One line for each pose that did not converge, saying which and why.
[[nodiscard]] std::vector<std::string> failures(const SweptQuantity& swept,
                                                const SweepResult& sweep);

}  // namespace condyle
