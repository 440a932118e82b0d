#pragma once

/// How far a surface rises over its osculating quadric and over its tangent plane, towards the
/// solid that touches it: what a bound on the gap has to allow for.
///
/// At a sample the height h of every other sample over the tangent plane is compared with ½ tᵀ K t.
/// What lies between the samples is allowed for: a maximum between them exceeds the highest sample
/// by no more than the curvature there over half a cell, plus what the surface departs from the
/// sample's own quadric within its cell, measured on its rim; near the sample the curvature itself
/// bounds the rise. So is the way from the sample to the point of contact whose quadric is meant. A
/// surface without samples tells nothing, unless it bends evenly (plane, sphere, cylinder).

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

#include "surface/surface.h"

namespace condyle {

/// Of one shell of points about a sample [1/mm]; below zero where the surface bends away.
struct Rise {
  double over_quadric = 0;  ///< greatest (2 h - tᵀ K t)/t²; infinite where it turns away too far
  double over_plane = 0;    ///< greatest 2 h/t²: a paraboloid of revolution above the whole shell
};

class Bending {
 public:
  static constexpr int kLevels = 9;
  /// Outer radii of the shells about a sample [mm], ascending.
  using Radii = std::array<double, kLevels>;

  /// `spacing` of the samples [mm].
  Bending(const Surface& surface, double spacing, const Radii& radii);

  /// Shells in equal ratios, from one that holds the neighbours of a sample to one of radius
  /// `greatest` [mm].
  [[nodiscard]] static Radii shells(double spacing, double greatest);

  /// The sample nearest to a point of the surface, walking from the sample `start` (-1: from any);
  /// -1 where no sample is near.
  [[nodiscard]] int nearest(const Eigen::Vector3d& point, int start) const;

  /// a >= 0 [1/mm] with h - ½ tᵀ K t <= ½ a t² for all points within `radius` [mm] of a point in
  /// the cell of `sample`, where the curvature tensor is K; infinite where the surface turns away
  /// too far. Measured when a sample is first asked for.
  [[nodiscard]] double within(double radius, int sample, const Eigen::Matrix3d& K);

  /// The same of shell `level` alone, and over the plane.
  [[nodiscard]] Rise in_shell(int level, int sample, const Eigen::Matrix3d& K);

  /// The greatest curvature away from the solid that touches the surface, over all cells [1/mm].
  [[nodiscard]] double greatest_convexity() const { return greatest_convexity_; }

 private:
  /// The surface about a sample, as far as half the way to its neighbours.
  struct Cell {
    double radius = 0;     ///< [mm]
    double rise = 0;       ///< greatest 2 h - tᵀ K t over the sample's own quadric [mm]
    double curvature = 0;  ///< greatest change of the curvature tensor [1/mm]
  };
  struct Shells {
    std::array<Rise, kLevels> of;
    std::array<double, kLevels> within;  ///< up to and with each shell; the first < 0: not measured
  };
  struct Tree;
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const;
  [[nodiscard]] Cell cell_of(const Surface& surface, const Place& place, std::size_t sample) const;
  [[nodiscard]] Rise rise_of(std::size_t cell, std::size_t base) const;
  void measure(std::size_t sample);
  [[nodiscard]] double shift(std::size_t sample, const Eigen::Matrix3d& K) const;

  Radii radii_;
  bool even_;
  std::vector<SurfacePoint> samples_;
  std::vector<Cell> cells_;
  double greatest_convexity_ = 0;
  std::shared_ptr<const Tree> tree_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<std::array<int, 8>> neighbours_;
  std::vector<Shells> shells_;
};

/// For each point the up to eight nearest others within `radius` [mm]; -1 fills up.
[[nodiscard]] std::vector<std::array<int, 8>> nearest_neighbours(
    const std::vector<Eigen::Vector3d>& points, double radius);

/// Heights over the tangent plane at c, points nearer than `least` [mm] to the normal counted as at
/// that distance; a normal that turns by more than 60 degrees is too far away.
class BendingMeter {
 public:
  BendingMeter(const Eigen::Vector3d& c, const Eigen::Vector3d& n, const Eigen::Matrix3d& K)
      : c_(c), n_(n), K_(K) {}
  [[nodiscard]] Rise at(const Eigen::Vector3d& point,
                        const Eigen::Vector3d& normal,
                        double least) const;

 private:
  Eigen::Vector3d c_, n_;
  Eigen::Matrix3d K_;
};

}  // namespace condyle
