#pragma once

/// The lowest gap of two surfaces at a pose, looked for on all of the known part of both: branch
/// and bound over the cells of one, with the distance to the other. Nothing is taken over from
/// other poses.

#include <optional>
#include <vector>

#include "condyle/math/rigid_transform.h"
#include "condyle/verify/side.h"

namespace condyle::verification {

struct LowestGap {
  /// [mm], negative: overlap; NaN: no number.
  double gap = std::numeric_limits<double>::infinity();
  Vector3d point;     ///< in the frame of the sampled side
  bool exact = true;  ///< false: nothing is found, and there were too many places to look at all
  /// Some of the sampled side faces the same way as the other, deeper behind it than that is solid for certain. That is no
  /// gap: either's bone may end between them.
  bool behind = false;
};

/// Samples one side; the sides must outlive it.
class GapProbe {
 public:
  static constexpr double kNoise =
      5e-7;  ///< gaps of which no lower ones are looked for beside [mm]

  GapProbe(const SurfaceSide& sampled, const SurfaceSide& other);

  /// Does the sampled side have bounds, so that there is anything to look at?
  [[nodiscard]] bool covers() const { return !cells_.empty(); }

  /// X takes the sampled side's frame to the other's. Exact where the lowest gap is within a fraction
  /// of a cell of `wanted` or below it; where it is greater, the lowest that was met; an overlap to 1 % of
  /// its depth. `wanted` [mm], at most 0: gaps above it need not be told apart.
  /// NaN where numbers are too great to tell.
  [[nodiscard]] LowestGap lowest(const RigidTransform& X, double wanted = 0) const;

 private:
  struct Node {
    Cell cell;
    Vector3d middle;
    double radius, curvature;
  };
  struct Reading {
    double gap;
    bool known;   ///< on both sides
    bool behind;  ///< as LowestGap::behind; not known then
    Vector3d point;
    Eigen::Vector2d gradient;  ///< per unit of parameter
    double slope;              ///< of the gap along the surface, per mm
    ClosestPoint closest;      ///< on the other side
  };
  struct Group {
    Vector3d middle;
    double radius;
    std::size_t begin, end;  ///< in cells_
  };
  void group(std::size_t begin, std::size_t end);
  [[nodiscard]] Node node(const Cell& cell) const;
  /// `near`, where given, is that of a point beside.
  [[nodiscard]] Reading read(const RigidTransform& X,
                             int chart,
                             double u,
                             double v,
                             const ClosestPoint* near = nullptr) const;
  [[nodiscard]] Eigen::Vector2d scales(int chart, double u, double v) const;
  /// Of the gap over the chart, its parameters in mm [1/mm].
  [[nodiscard]] Eigen::Matrix2d hessian(
      const RigidTransform& X, int chart, double u, double v, const Reading& at) const;
  /// What is looked for at one pose.
  struct Search {
    const RigidTransform& X;
    double wanted = 0;  ///< as of lowest()
    LowestGap best = {};
    bool behind = false;
    int left =
        120000;  ///< closest points that may still be asked for; below 0 not all was looked at
  };
  void look(const Node& node, const ClosestPoint* near, Search& search) const;
  void look_into(const Node& node, const Reading& at, Search& search) const;
  void divide(const Node& node, const Reading& at, Search& search) const;
  [[nodiscard]] double bound_by_bending(const Node& node, const Reading& at, Search& search) const;
  void look_closely(const Node& node, const ClosestPoint* near, Search& search) const;
  /// The local minimum that a place leads to; infinite where it is not known.
  [[nodiscard]] LowestGap refine(
      const RigidTransform& X, int chart, double u, double v, const ClosestPoint* near) const;

  const SurfaceSide &sampled_, &other_;
  double leaf_ = 0;  ///< radius of a cell that is not divided any more [mm]
  std::vector<Node> cells_;
  std::vector<Group> groups_;
};

}  // namespace condyle::verification
