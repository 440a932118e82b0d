#include "condyle/verify/layer_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/verify/layer_grid.h"

namespace condyle::verification {
namespace {

/// The stored points, each by its own place and the point closest to it.
LayerResultant check_field(const ContactResult& contact,
                           const PairOfSides& pair,
                           const RigidTransform& X,
                           const LayersInSeries& law,
                           const std::string& element,
                           Ledger& ledger) {
  const double weight = share_of_a_side(pair);
  const std::array<LayerPoints, 2> sides = sides_of(pair, X);
  LayerResultant all;
  for (const PressurePoint& point : contact.pressures) {
    const LayerPoints& side = sides[point.on_A ? 1 : 0];
    const ClosestPoint own = side.own.closest(point.point),
                       closest = side.other.closest(side.to_other * point.point);
    const double far = 1e-14 * (point.point.norm() + X.p.norm());
    ledger.note(Check::kOnSurface, (own.point - point.point).norm(), element, "", 1e-8 + 100 * far);
    ledger.note(Check::kDepth, std::abs(point.depth + closest.distance), element,
                fmt::format("is stored {:.9g} mm deep at [{:.3f}, {:.3f}, {:.3f}] mm, but lies "
                            "{:.9g} mm within the other surface",
                            point.depth, point.point.x(), point.point.y(), point.point.z(),
                            -closest.distance),
                1e-7 + 100 * far);
    const double p = law.pressure(point.depth);
    ledger.note(Check::kPressure, std::abs(point.pressure - p) / std::max(p, 1e-6), element);
    all.press(side, X, point.point, closest, weight * point.area * point.pressure);
  }
  return all;
}

void check_sums(const LayerResultant& field,
                const ContactResult& contact,
                const std::string& element,
                Ledger& ledger) {
  const LayerResult& layer = *contact.layer;
  const double scale = std::max(field.sum, 1e-9);
  ledger.note(Check::kLayerSums, (field.force - layer.force).norm() / scale, element,
              fmt::format("its pressures add up to {:.10g} N, the file says {:.10g} N",
                          field.force.norm(), layer.force.norm()));
  ledger.note(Check::kLayerSums, std::abs(contact.force - layer.force.norm()) / scale, element);
  ledger.note(Check::kLayerSums, std::abs(layer.area * layer.mean_pressure - field.sum) / scale,
              element);
  const double arm = std::max(1.0, field.moment.norm() / scale);
  ledger.note(
      Check::kLayerSums, (field.moment - layer.moment).norm() / (scale * arm), element,
      "its pressures have another moment about the moving body's origin than the file says");
}

/// Against the law on a grid of one's own.
void check_force(const std::optional<LayerResultant>& anew,
                 const ContactDescription& described,
                 const ContactResult& contact,
                 const LayersInSeries& law,
                 Ledger& ledger) {
  const std::string element = fmt::format("contact \"{}\"", described.name);
  if (!anew) {
    ledger.leave_out("the force of " + element +
                     " on a grid of its own: too many places to look at");
    return;
  }
  const double stored = contact.layer ? contact.layer->force.norm() : 0;
  ledger.note(Check::kLayerForce,
              std::abs(anew->force.norm() - stored) / (std::max(stored, anew->sum) + kLightForce),
              element,
              fmt::format("carries {:.6g} N, its law on a grid of its own {:.6g} N", stored,
                          anew->force.norm()),
              0.01 + 3 * described.layer->tolerance);
  ledger.note(Check::kLayerDepth, anew->deepest, element,
              fmt::format("is pressed {:.4g} mm deep, its layers bear {:.4g} mm", anew->deepest,
                          law.deepest()),
              kDepthAllowed * law.deepest());
}

}  // namespace

void check_layers(const Subject& subject, const PoseResult& pose, Ledger& ledger) {
  const Scene& scene = subject.run.scene;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (!scene.contacts[i].layer) continue;
    const std::string element = fmt::format("contact \"{}\"", scene.contacts[i].name);
    const PairOfSides pair = pair_of(subject, i);
    const LayersInSeries law(scene, pair, scene.contacts[i].layer->pressure);
    const ContactResult& contact = pose.contacts[i];
    check_force(resultant_on_grid(pair, pose.X_BA, law), scene.contacts[i], contact, law, ledger);
    if (!contact.layer) continue;
    check_sums(check_field(contact, pair, pose.X_BA, law, element, ledger), contact, element,
               ledger);
  }
}

double bearable_depth(const Subject& subject, std::size_t contact) {
  const Scene& scene = subject.run.scene;
  return LayersInSeries(scene, pair_of(subject, contact), scene.contacts[contact].layer->pressure)
      .deepest();
}

double layer_energy(const Subject& subject, const PoseResult& pose, const RigidTransform& X) {
  const Scene& scene = subject.run.scene;
  double energy = 0;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (!scene.contacts[i].layer || !pose.contacts[i].layer) continue;
    const PairOfSides pair = pair_of(subject, i);
    const LayersInSeries law(scene, pair, scene.contacts[i].layer->pressure);
    const double weight = share_of_a_side(pair);
    const std::array<LayerPoints, 2> sides = sides_of(pair, X);
    for (const PressurePoint& point : pose.contacts[i].pressures) {
      const LayerPoints& side = sides[point.on_A ? 1 : 0];
      const double depth = -side.other.closest(side.to_other * point.point).distance;
      energy += weight * point.area * law.energy(depth);
    }
  }
  return energy;
}

}  // namespace condyle::verification
