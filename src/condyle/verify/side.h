#pragma once

/// Surfaces as the verifier sees them: written from the definitions in the scene and in /patches,
/// with nothing of the room `surface`. A side of a contact is covered by charts (for grids of
/// points) and knows the closest point to any point on it (for distances). Lengths in mm, in the frame of
/// the body that carries the surface.

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <vector>

#include "condyle/results/run_file.h"

namespace condyle::verification {

using Eigen::Vector3d;

/// A rectangle of the parameters of one chart.
struct Cell {
  int chart = 0;
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
};

struct ChartPoint {
  Vector3d p, p_u, p_v;  ///< [mm], and per unit of parameter
};

/// What is nearest to a point on a surface.
struct ClosestPoint {
  double distance = 0;   ///< along the normal, negative within the solid [mm]
  Vector3d point, n;     ///< the closest, and the unit normal out of the solid there
  double edge = 0;       ///< from the closest to the end of the known part, negative beyond it [mm]
  double curvature = 0;  ///< no principal curvature about the closest is greater [1/mm]
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< of the closest on a spline
};

class SurfaceSide {
 public:
  virtual ~SurfaceSide() = default;

  /// Cells that cover the known part, no wider than about `size`; none for a surface without
  /// bounds.
  [[nodiscard]] virtual std::vector<Cell> cells(double size) const = 0;
  /// The longest way round or across it [mm]: of a torus round the outside, of a ball a quarter round; infinite
  /// without bounds, 0 of a spline.
  [[nodiscard]] virtual double longest_way() const = 0;
  /// How deep behind its known part all is solid for certain [mm]. A patch, or a polynomial that stands for one, tells
  /// that to as far as it reaches from its middle: deeper its bone may end. Others tell it to any depth.
  [[nodiscard]] virtual double solid_depth() const {
    return std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] virtual ChartPoint at(int chart, double u, double v) const = 0;
  /// As ClosestPoint::edge, of a point of a chart.
  [[nodiscard]] virtual double edge(int chart, double u, double v) const = 0;
  /// No principal curvature about a point of a chart is greater [1/mm].
  [[nodiscard]] virtual double curvature(int chart, double u, double v) const = 0;

  [[nodiscard]] virtual ClosestPoint closest(const Vector3d& p) const = 0;
  /// The same, searched from that of a point near p.
  [[nodiscard]] virtual ClosestPoint closest_near(const Vector3d& p, const ClosestPoint&) const {
    return closest(p);
  }
  /// Is p outside the solid and certainly farther than r from the surface? `false` says nothing.
  [[nodiscard]] virtual bool is_clear(const Vector3d& p, double r) const {
    return closest(p).distance > r;
  }
};

/// The sides of a run's surfaces, in the order of Scene::surfaces. Throws InputError where a patch
/// is missing or is no patch.
[[nodiscard]] std::vector<std::unique_ptr<SurfaceSide>> make_sides(const Run& run);

[[nodiscard]] std::unique_ptr<SurfaceSide> make_exact_side(const SurfaceDescription& surface);
[[nodiscard]] std::unique_ptr<SurfaceSide> make_spline_side(const PatchData& patch);

}  // namespace condyle::verification
