#include "condyle/specimen/check_layers.h"

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/surface/layer_fold.h"

namespace condyle {
namespace {

constexpr double kMost = 0.25, kSome = 0.05;  // of the known part of a patch

/// "1.5 mm at (1.0, 2.0, 3.0) mm".
std::string least_radius(const LayerFold& fold) {
  return fmt::format("{:.4g} mm at ({:.1f}, {:.1f}, {:.1f}) mm", fold.least_radius, fold.where.x(),
                     fold.where.y(), fold.where.z());
}

void check_layer(const Scene& scene, const SurfaceDescription& surface, FittedSurface& fitted) {
  const double thickness = surface.elastic->layer;
  const LayerFold fold = layer_fold(*fitted.surface, thickness);
  const bool is_patch = surface.kind == SurfaceKind::kPatch;
  if (fold.share() > (is_patch ? kMost : 0))
    throw InputError(fmt::format(
        "{}: surface \"{}\": layer = {:.6g}, expected a thickness less than the radii of "
        "curvature of its surface: it folds over on {:.0f} % of the known part, and the least is "
        "{}",
        scene.file.string(), surface.name, thickness / scene.length_to_mm, 100 * fold.share(),
        least_radius(fold)));
  if (fold.share() > kSome && fitted.report)
    fitted.report->notes.push_back(fmt::format(
        "warning: a layer of {:g} mm is thicker than the radius of curvature on {:.0f} % of the "
        "patch, the least is {}: pressures there mean nothing",
        thickness, 100 * fold.share(), least_radius(fold)));
}

}  // namespace

void check_layers(const Scene& scene, std::vector<FittedSurface>& surfaces) {
  std::vector<bool> done(surfaces.size());
  for (const ContactDescription& contact : scene.contacts) {
    if (!contact.layer) continue;
    for (const int s : contact.surfaces) {
      const auto i = static_cast<std::size_t>(s);
      const SurfaceDescription& surface = scene.surfaces[i];
      const bool bends =
          surface.kind == SurfaceKind::kPatch || surface.kind == SurfaceKind::kPolynomial;
      if (done[i] || !surface.elastic || !bends) continue;
      done[i] = true;
      check_layer(scene, surface, surfaces[i]);
    }
  }
}

}  // namespace condyle
