#include "condyle/specimen/check_layers.h"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/input_error.h"
#include "condyle/scene_file/document.h"
#include "condyle/surface/layer_fold.h"

namespace condyle {
namespace {

constexpr const char* kThickLayer = "warning: a layer of ";

constexpr double kMost = 0.25, kSome = 0.05;  // of the known part of a patch

/// "1.5 mm at (1.0, 2.0, 3.0) mm".
std::string least_radius(const LayerFold& fold) {
  return fmt::format("{:.4g} mm at ({:.1f}, {:.1f}, {:.1f}) mm", fold.least_radius, fold.where.x(),
                     fold.where.y(), fold.where.z());
}

/// File, line and table of a surface's layer, as far as the scene still has its text.
std::string place_of_layer(const Scene& scene, std::size_t surface) {
  const std::string file = scene.file.string();
  const std::string table = fmt::format("[[surface]] \"{}\"", scene.surfaces[surface].name);
  const Value document = parse_document(scene.text, file);
  const Value* tables = document.find("surface");
  const Value* layer = tables != nullptr && surface < tables->items.size()
                           ? tables->items[surface].find("layer")
                           : nullptr;
  return layer != nullptr ? fmt::format("{}:{}: {}", file, layer->line, table)
                          : fmt::format("{}: {}", file, table);
}

void check_layer(const Scene& scene, std::size_t index, FittedSurface& fitted) {
  const SurfaceDescription& surface = scene.surfaces[index];
  const double thickness = surface.elastic->layer;
  const LayerFold fold = layer_fold(*fitted.surface, thickness);
  const bool is_patch = surface.kind == SurfaceKind::kPatch;
  if (fold.share() > (is_patch ? kMost : 0))
    throw InputError(fmt::format(
        "{}: layer = {:.6g}, expected a thickness less than the radii of "
        "curvature of its surface: it folds over on {:.0f} % of the known part, and the least is "
        "{}",
        place_of_layer(scene, index), thickness / scene.length_to_mm, 100 * fold.share(),
        least_radius(fold)));
  if (fold.share() > kSome && fitted.report)
    fitted.report->notes.push_back(
        fmt::format("{}{:g} mm is thicker than the radius of curvature on {:.0f} % of the "
                    "patch, the least is {}: pressures there mean nothing",
                    kThickLayer, thickness, 100 * fold.share(), least_radius(fold)));
}

}  // namespace

bool carries_layer(const Scene& scene, int surface) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), [&](const auto& contact) {
    return contact.layer && std::find(contact.surfaces.begin(), contact.surfaces.end(), surface) !=
                                contact.surfaces.end();
  });
}

void check_layers(const Scene& scene, std::vector<FittedSurface>& surfaces) {
  for (FittedSurface& fitted : surfaces)
    if (fitted.report)
      std::erase_if(fitted.report->notes,
                    [](const std::string& note) { return note.starts_with(kThickLayer); });
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
      check_layer(scene, i, surfaces[i]);
    }
  }
}

}  // namespace condyle
