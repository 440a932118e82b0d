#pragma once

/// Points on one bone to their places on another of the same kind: alignment by frames and size,
/// then a non-rigid registration of the two surfaces, then down onto the bone.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

/// A bone and its anatomical frame, found by the same rule on both [mm]. Where one is a left and
/// the other a right bone, components in the frames mirror it.
struct FramedBone {
  const TriangleMesh& mesh;
  BoneFrame frame;
};

struct CarriedPoint {
  Eigen::Vector3d at;      ///< on the other bone, frame of its mesh [mm]
  double moved = 0;        ///< from where alignment by frames and size puts it [mm]
  double dropped = 0;      ///< distance of the last step, onto the bone [mm]; 0 where there is none
  double farther = 0;      ///< from this bone than from its own [mm]: where bone is missing
  double uncertainty = 0;  ///< estimated standard deviation of `at` along the bone [mm]
};

struct CarriedPoints {
  std::vector<CarriedPoint> points;  ///< in the order given
  Eigen::Vector3d
      size;            ///< factors along anterior, proximal, lateral from one bone to the other [-]
  double rms = 0;      ///< of the registered surfaces, where they face each other [mm]
  double covered = 0;  ///< share of the one bone's surface near the points that has a counterpart
};

/// `points` in the frame of `from.mesh`, on or near its surface [mm]. Either mesh may be cut or open:
/// beyond what they have in common a point goes with the field and is less sure. Frames may be off by
/// some degrees and mm. Throws InputError where the bones do not lie over each other.
[[nodiscard]] CarriedPoints carry_points(const FramedBone& from,
                                         const FramedBone& to,
                                         const std::vector<Eigen::Vector3d>& points);

}  // namespace condyle
