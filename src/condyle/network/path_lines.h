#pragma once

/// Lines of a network whose way between their ports is not straight (elements/line_path.h): what each
/// keeps from one moment to the next.

#include "condyle/network/kinematics.h"

namespace condyle {

class PathLines {
 public:
  explicit PathLines(const Network& network);

  struct Pull {
    double length = 0;  ///< [mm]; 0 where there is no path
    Vector6 wrench;     ///< of a tension of 1 N on the body, about its port
  };
  /// Of a line from the ground to a body, the path on whichever surfaces it touches at this pose.
  Pull pull(std::size_t line, const Kinematics& at);

  /// What the paths keep, one line after the other, as KeptPaths hands it out.
  [[nodiscard]] const std::vector<double>& kept() const { return kept_; }
  /// As many numbers as these.
  void keep(const std::vector<double>& kept) { kept_ = kept; }

 private:
  const Network& network_;
  std::vector<std::size_t> first_;  ///< of the numbers of each line
  std::vector<double> kept_;
};

}  // namespace condyle
