#pragma once

/// The length L₀ of a path where it was last followed, kept with the pose. A shortest path that is held
/// changes its length at most by what the ends of the pieces that cross from one body to the other
/// move apart. With d = |Δx_D|, and θ the angle by which A has turned,
///     all surfaces on B, or all on A    L <= L₀ + d, D (or C) as what leads the path sees it
///     k pieces that cross               L <= L₀ + k (d + θ L),  hence L <= (L₀ + k d)/(1 - k θ)
/// and where the last piece begins at Q on a convex surface, the rest before it L_Q, the string over Q is
/// a longer one: L <= L_Q + |x_D - Q| while D is above the tangent plane of Q, and by at most the depth h
/// more below it. Without a surface that is L itself. No force is in a strand whose bound is below its
/// slack length.

#include <vector>

#include "condyle/elements/line_path.h"
#include "condyle/wrapping/path_pose.h"

namespace condyle {

/// What leads a path: how its length may change with the pose.
struct PathLead {
  bool all_on_B = true, all_on_A = false;
  int crossings = 1;  ///< most pieces that run from one body to the other
};

/// The piece that ends where the path's end moves: where it begins, as what leads the path sees it.
struct LastPiece {
  Eigen::Vector3d begin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the convex surface there; 0 at an end
  double rest = -1;  ///< length of the path without it [mm]; less than 0 where it is not known
};

[[nodiscard]] PathLead lead_of(const std::vector<PathSurface>& surfaces, const PathEnds& ends);

/// `noted`: PathState::noted(), null where nothing can be noted.
[[nodiscard]] bool is_noted(const double* noted);
void note_length(const PathLead& lead,
                 const LineEnds& ends,
                 const RigidTransform& X_BA,
                 double length,
                 const LastPiece& last,
                 double* noted);

/// Noted at this very pose.
[[nodiscard]] bool noted_at(const PathLead& lead,
                            const LineEnds& ends,
                            const RigidTransform& X_BA,
                            const double* noted);

/// No less than L here [mm]; infinite where that is not known.
[[nodiscard]] double length_at_most(const PathLead& lead,
                                    const LineEnds& ends,
                                    const RigidTransform& X_BA,
                                    const double* noted);

}  // namespace condyle
