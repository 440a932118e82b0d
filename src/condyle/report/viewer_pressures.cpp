#include "condyle/report/viewer_pressures.h"

#include <algorithm>
#include <cmath>

#include "condyle/pictures/knee_shapes.h"
#include "condyle/pictures/pressure_map.h"

namespace condyle {
namespace {

constexpr double kLevels = 254;  // above none

char level(double part) {
  if (!(part > 0)) return 0;
  return static_cast<char>(
      static_cast<unsigned char>(1 + std::lround(kLevels * std::min(part, 1.0))));
}

std::string levels_of(const RunShape& shape,
                      std::size_t surface,
                      const PressureMap& map,
                      const std::vector<RigidTransform>& X_P) {
  std::string levels;
  for (std::size_t i = 0; i < shape.mesh.vertices.size(); ++i) {
    const auto pressure = map.pressure(surface, shape.mesh.vertices[i], shape.normals[i], X_P);
    levels += level(pressure.value_or(0) / map.top());
  }
  return levels;
}

}  // namespace

ViewerPressures viewer_pressures(const Run& run,
                                 const ShapeOptions& options,
                                 const std::vector<ShownPose>& shown) {
  ViewerPressures all;
  if (!(greatest_pressure(run) > 0)) return all;
  const PressureMap map(run);
  all.top = map.top();
  for (const RunShape& shape : run_shapes(run, options)) {
    const auto surface = std::find_if(run.scene.surfaces.begin(), run.scene.surfaces.end(),
                                      [&](const auto& s) { return s.name == shape.name; });
    if (shape.bone || surface == run.scene.surfaces.end()) continue;
    all.surfaces.push_back({shape.name, {}});
    for (const ShownPose& pose : shown)
      all.surfaces.back().levels +=
          levels_of(shape, static_cast<std::size_t>(surface - run.scene.surfaces.begin()), map,
                    body_poses(run.scene, run.sweep.poses[pose.index].X_BA));
  }
  return all;
}

}  // namespace condyle
