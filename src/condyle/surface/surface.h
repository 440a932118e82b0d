#pragma once

/// A smooth surface bounding a solid, as contact mechanics sees it [Dortmans 1986, 2.18-2.44].
///
/// At a place on the surface mechanics wants the point c, the unit normal n that points OUT of the
/// solid, and the curvature tensor K with dn = -K dc (symmetric, K n = 0). With this sign a ball of
/// radius r has K = -(I - nn)/r and a cup of radius r has K = +(I - nn)/r.
///
/// A `Place` is whatever the surface uses to name one of its points: (u, v, 0) on a patch, the
/// point itself on an exact surface. Only the surface reads its numbers. The mechanics moves places
/// by tangent displacements, so no chart has a pole for it.
///
/// All lengths in mm, in the frame of the body that carries the surface.

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <vector>

namespace condyle {

struct Place {
  Eigen::Vector3d numbers;

  bool operator==(const Place&) const = default;
};

struct SurfacePoint {
  Eigen::Vector3d c;  ///< point [mm]
  Eigen::Vector3d n;  ///< unit normal, out of the solid
  Eigen::Matrix3d K;  ///< curvature tensor [1/mm], dn = -K dc
  Eigen::Matrix<double, 3, 2>
      dual;  ///< reciprocal tangents g_u, g_v: du = g_u.dc, dv = g_v.dc; patches only
};

/// Where the known part of a surface is and how large.
struct Extent {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of an unbounded surface a point of it [mm]
  double radius =
      std::numeric_limits<double>::infinity();  ///< root mean square distance from the centre [mm];
                                                ///< infinite for an unbounded surface
};

class Surface {
 public:
  virtual ~Surface() = default;

  /// Point, normal and curvature at a place. Must not allocate; finite for every finite place.
  [[nodiscard]] virtual SurfacePoint evaluate(const Place& place) const = 0;

  /// The same without the curvature (K is not to be used), where that is cheaper.
  [[nodiscard]] virtual SurfacePoint evaluate_frame(const Place& place) const {
    return evaluate(place);
  }

  /// The place reached from `at` (evaluated there) by the tangent displacement dc [mm]; on the
  /// surface, and equal to the true displacement to first order.
  [[nodiscard]] virtual Place moved(const Place& place,
                                    const SurfacePoint& at,
                                    const Eigen::Vector3d& dc) const = 0;

  /// The place that is meant by numbers computed from those of places near each other: a mean, say.
  [[nodiscard]] virtual Place place_of(const Eigen::Vector3d& numbers) const {
    const Place place{numbers};
    return moved(place, evaluate_frame(place), Eigen::Vector3d::Zero());
  }

  /// The place closest to point p [mm], searched locally from `start`.
  [[nodiscard]] virtual Place closest(const Eigen::Vector3d& p, const Place& start) const = 0;

  /// A place to start `closest` from when nothing better is known.
  [[nodiscard]] virtual Place seed(const Eigen::Vector3d& p) const = 0;

  /// Distance from the place to the edge of the part that is known from data [mm]: negative beyond
  /// it, infinite for a surface without an edge.
  [[nodiscard]] virtual double edge_distance(const Place&) const {
    return std::numeric_limits<double>::infinity();
  }

  /// Are the principal curvatures the same everywhere (plane, sphere, cylinder)?
  [[nodiscard]] virtual bool bends_evenly() const { return false; }

  /// Places that cover the surface, neighbours about `spacing` [mm] apart, for the search for
  /// contacts. Empty for a surface without bounds (plane, cylinder): then the other surface of a
  /// pair is sampled.
  [[nodiscard]] virtual std::vector<Place> samples(double spacing) const = 0;

  [[nodiscard]] virtual Extent extent() const = 0;

  /// The same surface moved by d [mm]: places of exact surfaces move with it, (u, v) of a patch
  /// stay.
  [[nodiscard]] virtual std::unique_ptr<Surface> translated(const Eigen::Vector3d& d) const = 0;
};

}  // namespace condyle
