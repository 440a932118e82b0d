#pragma once

/// The shortest string between two points outside a solid: nodes at equal distances along it that
/// minimise ½ Σ |x_k+1 - x_k|² while none lies inside. Meant for bones, once for each strand and
/// pose; ligaments of a model go over smooth surfaces (wrapping/wrapped_path.h).

#include <functional>
#include <vector>

#include "condyle/surface/smoothed_mesh.h"

namespace condyle {

/// Height over a solid and its normal, near its surface.
using HeightOver = std::function<SurfaceHeight(const Eigen::Vector3d&)>;

struct StringOptions {
  int pieces = 80;
  int iterations = 3000;    ///< at most
  double tolerance = 1e-9;  ///< of a step of any node [mm]
  double settled = 5e-3;    ///< else of the length over the last 10 iterations [mm]
  double longest_step = 1;  ///< of a node [mm]
};

/// A point where a string presses on the solid.
struct StringTouch {
  Eigen::Vector3d point;   ///< [mm]
  Eigen::Vector3d normal;  ///< unit, out of the solid
};

struct BonePath {
  bool found = false;
  double length = 0;    ///< [mm]
  double straight = 0;  ///< distance of the ends, where they are outside [mm]
  double depth = 0;     ///< of the straight line in the solid, at most [mm]; 0 outside
  std::array<double, 2> moved = {0, 0};  ///< how far the ends were moved out of the solid [mm]
  std::vector<Eigen::Vector3d> points;   ///< nodes, ends included
  std::vector<StringTouch> touches;      ///< nodes that press
};

/// From nodes on the side where the string shall pass; ends stay where they are.
[[nodiscard]] BonePath relaxed_string(const HeightOver& solid,
                                      std::vector<Eigen::Vector3d> nodes,
                                      const StringOptions& options = {});

/// Between x and y about a bone. Ends inside are moved to its surface. The side is the one to which
/// the straight line comes out of the bone after the least way.
[[nodiscard]] BonePath bone_string(const SmoothedMesh& bone,
                                   const Eigen::Vector3d& x,
                                   const Eigen::Vector3d& y,
                                   const StringOptions& options = {});

/// How deep the straight line from x to y lies in the bone [mm], at most; 0 outside.
[[nodiscard]] double depth_of_line(const SmoothedMesh& bone,
                                   const Eigen::Vector3d& x,
                                   const Eigen::Vector3d& y);

}  // namespace condyle
