#include "condyle/pictures/fit_map.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/surface_shapes.h"
#include "condyle/results/strain_scale.h"
#include "condyle/surface/fit_figures.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

constexpr double kSpacing = 0.35;  // of the vertices that carry colours [mm]

/// A round number that `share` of the magnitudes on the known part do not exceed.
double colour_limit(const Patch& patch,
                    const std::function<double(const SurfacePoint&)>& magnitude,
                    double share) {
  std::vector<double> values;
  for (const Place& place : patch.samples(1))
    if (patch.edge_distance(place) >= 0) values.push_back(magnitude(patch.evaluate(place)));
  if (values.empty()) return 1;
  const auto rank =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return round_up_nicely(std::max(*rank, 1e-6));
}

}  // namespace

FitMap deviation_map(const FittedSurface& fitted) {
  const auto distance = std::make_shared<const MeshDistance>(fitted.region);
  FitMap map{.panel = "red: the mesh lies outside the patch, blue: inside",
             .title = "Distance",
             .unit = "mm"};
  map.value = [distance](const SurfacePoint& at) {
    const Eigen::Vector3d off = distance->closest(at.c) - at.c;
    return std::copysign(off.norm(), at.n.dot(off));
  };
  map.limit = colour_limit(
      dynamic_cast<const Patch&>(*fitted.surface),
      [&](const SurfacePoint& at) { return std::abs(map.value(at)); }, 0.99);
  return map;
}

FitMap curvature_map(const Patch& patch, Principal which) {
  const std::size_t index = which == Principal::kLeast ? 0 : 1;
  FitMap map{.panel = which == Principal::kLeast ? "least principal curvature"
                                                 : "greatest principal curvature",
             .title = "Curvature",
             .unit = "1/mm"};
  map.value = [index](const SurfacePoint& at) { return principal_curvatures(at)[index]; };
  map.limit = colour_limit(
      patch,
      [](const SurfacePoint& at) {
        const auto [least, greatest] = principal_curvatures(at);
        return std::max(std::abs(least), std::abs(greatest));
      },
      0.85);
  return map;
}

ShadedMesh painted(const Patch& patch, const FitMap& map) {
  return painted_patch(
      patch,
      [&](const SurfacePoint& at) {
        return Paint{map_color(ColorMap::kDiverging, 0.5 + 0.5 * map.value(at) / map.limit)};
      },
      kSpacing);
}

}  // namespace condyle
