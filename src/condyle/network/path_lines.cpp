#include "condyle/network/path_lines.h"

#include <Eigen/Geometry>

#include "condyle/elements/line_path.h"
#include "condyle/math/no_number.h"

namespace condyle {

PathLines::PathLines(const Network& network) : network_(network) {
  std::size_t numbers = 0;
  for (const LineComponent& line : network.lines) {
    first_.push_back(numbers);
    if (line.path) numbers += static_cast<std::size_t>(line.path->numbers());
  }
  kept_.assign(numbers, kNoNumber);
}

PathLines::Pull PathLines::pull(std::size_t line, const Kinematics& at) {
  constexpr int kMostChanges = 16;  // of what it touches
  const LineComponent& component = network_.lines[line];
  const RigidTransform& X = at.poses()[static_cast<std::size_t>(network_.ports[component.to].body)];
  const Eigen::Vector3d& x_D = at.point(component.to);
  const LineEnds ends{at.point(component.from), x_D, x_D - X.p};
  double* kept = kept_.data() + first_[line];
  Pull pull;
  Wrench unit;
  for (int k = 0; k < kMostChanges; ++k) {
    pull.length = component.path->pull(ends, X, kept, unit);
    if (!component.path->revise(ends, X, kept)) break;
  }
  pull.wrench << unit.f, unit.m - ends.q.cross(unit.f);
  return pull;
}

}  // namespace condyle
