#pragma once

/// Points of a surface that stay where they are on it, each with the area it stands for: what the
/// energy of an elastic layer is summed over (layer_contact.h). On a patch they are the midpoints
/// of equal cells in each knot span, divided where it is wider than 4 mm, on an exact surface of cells of its charts. The integrand has a bounded support and a kink only at the
/// edge of the contact, where a lattice of midpoints beats Gauss' points: with cells of H the
/// errors of energy, force and stiffness fall as H^7/2, H^5/2, H^3/2.

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

#include "condyle/surface/patch.h"

namespace condyle {

/// Neighbouring points: all within a ball.
struct LayerBlock {
  std::size_t first = 0, count = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [mm]
  double radius = 0;                                 ///< [mm]
};

/// Of one surface, in its body's frame.
struct LayerLattice {
  std::vector<Eigen::Vector3d> x, n;     ///< point [mm] and outward unit normal
  std::vector<double> area;              ///< [mm²]
  std::vector<double> faded;             ///< what the border took of it [mm²]
  std::vector<Eigen::Vector2d> place;    ///< u, v of a patch
  std::vector<std::array<int, 3>> cell;  ///< which: chart, row and column
  std::vector<LayerBlock> blocks;
};

/// Of a patch, and of an exact surface whose spans are not wider than 4 mm: beside another one that is too large for that,
/// it alone is summed on.
[[nodiscard]] bool has_fine_lattice(const Surface& surface);

/// The corners of a lattice's cells: the same lattice shifted by half a cell in both directions.
struct LayerCorners {
  struct alignas(32) Point {
    double x_area[4];  ///< [mm], and the area that it stands for [mm²]
    double n[4];       ///< outward unit normal, and 0
  };
  std::vector<Point> points;  ///< one more than there are corners: the last stands for none
  std::vector<std::array<std::uint32_t, 4>> of_cell;  ///< corners of each point of the lattice

  [[nodiscard]] std::uint32_t none() const { return static_cast<std::uint32_t>(points.size() - 1); }
};

/// Width of the border at the edge of the known part over which areas fade to nothing [mm]: a hard
/// cut would leave poses without any equilibrium.
inline constexpr double kFade = 1;

/// Of `per_span` x `per_span` cells in each knot span, those on the known part; `shifted`: by half
/// a cell in both directions. `fade`: width of the border [mm].
[[nodiscard]] LayerLattice layer_lattice(const Patch& patch,
                                         int per_span,
                                         bool shifted = false,
                                         double fade = kFade);

/// The same of any surface, an exact one in spans of 2 mm, or as many as a great one may have. No
/// points where it has no bounds.
[[nodiscard]] LayerLattice layer_lattice(const Surface& surface,
                                         int per_span,
                                         bool shifted = false);

/// The corners of a lattice of the surface.
[[nodiscard]] LayerCorners layer_corners(const Surface& surface,
                                         int per_span,
                                         const LayerLattice& lattice);

}  // namespace condyle
