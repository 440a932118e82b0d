#pragma once

/// A C² spline patch through an articular region: regularised least squares with parameter
/// correction.
///
/// The chart of the region gives the first parameters; after each linear fit every vertex gets the
/// parameters of its closest point on the patch, until they settle, so that distances are measured
/// at right angles to the surface. The mathematics, and how the smoothing length is chosen, is in
/// docs/surface.md.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "condyle/surface/articular_region.h"
#include "condyle/surface/fit_smoothing.h"
#include "condyle/surface/patch.h"
#include "condyle/surface/region_outline.h"

namespace condyle {

struct FitOptions {
  std::optional<std::array<int, 2>> control_points = {};  ///< absent: from the knot spacing
  std::optional<double> smoothing_length = {};            ///< [mm]; absent: chosen from the data
  SmoothingAim aim = SmoothingAim::kNormals;              ///< of the choice
  int degree = 3;
  double knot_spacing = 2;  ///< [mm of chart length]
  int rounds = 6;           ///< of parameter correction, at most
  double settled = 0.02;    ///< rms change of the parameters that ends them [mm]
  bool to_the_edge =
      false;  ///< the known part ends where the data do: kUncertainRim is not cut off
};

/// The smoothing length near the edge of the articular face, where bones bend with small radii, as
/// a fraction of what is given or chosen: 1 from `band` [mm] within the edge, falling evenly to
/// `edge` on it and to `least` over 2 mm beyond.
struct EdgeSmoothing {
  double edge, band, least;
};
/// Of a choice for normals: the middle, where bones touch, is smoothed four times as much as the rim
/// that would blur it.
inline constexpr EdgeSmoothing kNormalsEdge{0.25, 12, 0.25};
/// Of a length that is given, and of a choice for positions.
inline constexpr EdgeSmoothing kPlainEdge{0.7, 8, 0.5};

/// A smoothing spline leans outwards near its last data: this margin of the data, in smoothing
/// lengths of the last data (EdgeSmoothing::least), does not count as known, and the mask of the
/// patch ends there.
inline constexpr double kUncertainRim = 1.2;

struct PatchFit {
  PatchData patch;                          ///< its mask: distance to the edge of what is known
  double smoothing_length = 0;              ///< [mm]
  double rim = 0;                           ///< of the data, that does not count as known [mm]
  double condition = 0;                     ///< of the normal equations
  int rounds = 0;                           ///< of parameter correction that were done
  std::vector<Eigen::Vector2d> parameters;  ///< of the closest point to each vertex of the region
  std::vector<double> distance;             ///< of each vertex, positive outside the patch [mm]
  std::vector<double> edge_distance;  ///< of each closest point from the edge of the data [mm]
  WideHoles holes = {};               ///< in the region, which are not known
  std::vector<std::string> notes;
};

/// Throws InputError (without the name of the surface) where the region is too small for the
/// control points.
[[nodiscard]] PatchFit fit_patch(const ArticularRegion& region, const FitOptions& options = {});

}  // namespace condyle
