/// Of a contact: whether its surfaces are rigid or carry by their elastic layers.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The smallest radius of an exact surface where its solid is convex [mm]: a layer that reaches
/// into the solid is thinner. Patches are judged where they are pressed.
double smallest_convex_radius(const SurfaceDescription& surface) {
  switch (surface.kind) {
    case SurfaceKind::kSphere:
    case SurfaceKind::kCylinder:
      // NOLINTNEXTLINE(bugprone-narrowing-conversions): it sees one from double to double.
      return surface.solid_inside ? surface.radius : kUnlimited;
    case SurfaceKind::kEllipsoid:
      return surface.solid_inside ? surface.semi_axes.minCoeff() * surface.semi_axes.minCoeff() /
                                        surface.semi_axes.maxCoeff()
                                  : kUnlimited;
    case SurfaceKind::kTorus:
      return surface.solid_inside ? surface.minor_radius : surface.radius - surface.minor_radius;
    default:
      return kUnlimited;
  }
}

double read_share(const Section& section, const char* key, double otherwise, double most) {
  const std::string expected = fmt::format("a part of the force, above 0 and at most {:g}", most);
  const double share = section.number_or(key, otherwise, expected);
  if (!(share > 0) || share > most) section.fail(key, expected);
  return share;
}

/// Refuses surfaces that no layer can stand between, by the key of the surface that is to blame.
void check_layers(const Section& contact,
                  const std::vector<Section>& surfaces,
                  const std::array<const SurfaceDescription*, 2>& pair,
                  const std::array<int, 2>& indices,
                  const Scene& scene) {
  if (!pair[0]->elastic && !pair[1]->elastic)
    contact.fail("law", fmt::format("modulus and layer of surface \"{}\" or \"{}\": both are rigid",
                                    pair[0]->name, pair[1]->name));
  for (std::size_t i = 0; i < 2; ++i) {
    if (!pair[i]->elastic) continue;
    const Section& section = surfaces[static_cast<std::size_t>(indices[i])];
    if (!(pair[i]->elastic->layer > 0))
      section.fail("modulus",
                   fmt::format("layer beside it (a thickness): contact {} is one of layers",
                               contact.label().substr(contact.label().find('"'))));
    if (pair[i]->elastic->poisson > kGreatestLayerPoisson)
      section.fail("poisson", fmt::format("at most {} of a layer that is pressed: nearer to 0.5 it "
                                          "moves sideways, which a foundation of springs cannot",
                                          kGreatestLayerPoisson));
    const double radius = smallest_convex_radius(*pair[i]);
    if (pair[i]->elastic->layer >= radius)
      section.fail("layer",
                   fmt::format("a thickness less than {:.6g}, the smallest radius of the surface",
                               radius / scene.length_to_mm));
  }
}

}  // namespace

void read_layers(const Section& root,
                 const Section& section,
                 const Scene& scene,
                 ContactDescription& contact) {
  static const Choices<bool> laws = {{"rigid", false}, {"layer", true}};
  static const Choices<PressureLaw> pressures = {{"linear", PressureLaw::kLinear},
                                                 {"logarithmic", PressureLaw::kLogarithmic}};
  if (!section.has("law") || !section.choice("law", laws)) {
    for (const char* key : {"pressure", "tolerance", "lost_force"})
      if (section.has(key)) section.fail(key, "law = \"layer\" beside it");
    return;
  }
  if (contact.state != ContactState::kAuto)
    section.fail("state", "\"auto\": layers open and close by themselves");
  const auto surface = [&](std::size_t i) {
    return &scene.surfaces[static_cast<std::size_t>(contact.surfaces[i])];
  };
  check_layers(section, root.sections("surface"), {surface(0), surface(1)}, contact.surfaces,
               scene);
  LayerOptions& options = contact.layer.emplace();
  if (section.has("pressure")) options.pressure = section.choice("pressure", pressures);
  options.tolerance = read_share(section, "tolerance", options.tolerance, 0.1);
  options.beyond = read_share(section, "lost_force", options.beyond, 1);
}

}  // namespace condyle
