#include "condyle/compare/compare.h"

#include <algorithm>
#include <cmath>

#include "condyle/compare/one_contact_each.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/reference/polynomial_surface.h"
#include "condyle/reference/wismans_solver.h"

namespace condyle {
namespace {

constexpr std::array<const char*, kVariantCount> kVariantNames = {
    "ours", "reference", "surfaces", "springs", "closed", "all three"};

double median_seconds(const SweepResult& sweep) {
  std::vector<double> seconds;
  for (const PoseResult& pose : sweep.poses)
    if (pose.converged()) seconds.push_back(pose.seconds);
  if (seconds.empty()) return std::nan("");
  const auto middle = seconds.begin() + std::ssize(seconds) / 2;
  std::nth_element(seconds.begin(), middle, seconds.end());
  return *middle;
}

double mean_iterations(const SweepResult& sweep) {
  double sum = 0;
  int count = 0;
  for (const PoseResult& pose : sweep.poses) {
    if (!pose.converged()) continue;
    sum += pose.iterations;
    ++count;
  }
  return count > 0 ? sum / count : std::nan("");
}

SweepResult plain_sweep(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  SweepOptions options;
  options.stability = options.events = false;
  return sweep(scene, surfaces, options);
}

/// Wismans' contacts are rigid points, and so are those of the steps that lead to his model.
Scene with_rigid_contacts(Scene scene) {
  for (ContactDescription& contact : scene.contacts) contact.layer.reset();
  return scene;
}

}  // namespace

const char* name(Variant variant) { return kVariantNames[static_cast<std::size_t>(variant)]; }

SweepResult reference_sweep(const Scene& scene,
                            const WismansModel& model,
                            const SweepResult& ours) {
  std::vector<RigidTransform> starts;
  for (const PoseResult& pose : ours.poses) {
    if (!pose.converged()) continue;
    starts.push_back(pose.X_BA);
    break;
  }
  const std::optional<std::size_t> load =
      scene.sweep->varies_load ? std::optional<std::size_t>(scene.sweep->index) : std::nullopt;
  return sweep(model, load, scene.sweep->values, starts);
}

void check_compared_scene(const Scene& scene) {
  const std::string file = scene.file.string();
  if (!scene.sweep) throw InputError(file + ": [sweep] is missing, expected one to compare over");
  check_wismans_scene(scene);
  if (scene.sweep->arc_length)
    throw InputError(file +
                     ": [sweep]: path = \"arc length\", expected \"steps\" for a comparison");
}

Comparison compare(const Scene& scene,
                   const std::vector<FittedSurface>& surfaces,
                   const SweepResult& ours,
                   const CompareOptions& options,
                   const OnProgress& on_sweep,
                   const SweepKeeping& keeping) {
  check_wismans_scene(scene);
  int sweeps_done = 0;
  const auto counted = [&](int number, const auto& compute) {
    SweepResult sweep = keeping.get(number, compute);
    ++sweeps_done;
    if (on_sweep)
      on_sweep(sweeps_done, kVariantCount);  // all but ours, and ours again for the time
    return sweep;
  };
  Comparison result;
  result.options = options;
  result.heights = fit_heights(scene, surfaces, options.degree);
  const Scene rigid = with_rigid_contacts(scene);
  const Scene quadratic = with_quadratic_springs(rigid, options.strain);
  for (const LigamentDescription& ligament : quadratic.ligaments)
    result.springs.push_back(ligament.law);
  const WismansModel model = build_wismans_model(quadratic, result.heights);
  const std::vector<FittedSurface> polynomials = with_polynomials(surfaces, result.heights);

  const auto of_variant = [&](Variant v, const auto& compute) {
    return counted(static_cast<int>(v), compute);
  };
  result.reference =
      of_variant(Variant::kReference, [&] { return reference_sweep(scene, model, ours); });
  const std::array<SweepResult, kVariantCount> sweeps = {
      ours,
      result.reference,
      of_variant(Variant::kSurfaces, [&] { return plain_sweep(rigid, polynomials); }),
      of_variant(Variant::kSprings, [&] { return plain_sweep(quadratic, surfaces); }),
      of_variant(Variant::kClosed,
                 [&] { return plain_sweep(with_closed_contacts(rigid), surfaces); }),
      of_variant(Variant::kAllThree,
                 [&] { return sweep_one_contact_each(quadratic, polynomials, result.reference); })};
  for (int v = 0; v < kVariantCount; ++v) result.converged[v] = sweeps[v].count_converged();
  for (const Quantity& quantity : compared_quantities(scene)) {
    ComparedQuantity compared{quantity.name, quantity.units, {}};
    for (int v = 0; v < kVariantCount; ++v) compared.values[v] = series(quantity, sweeps[v]);
    result.quantities.push_back(std::move(compared));
  }
  const SweepResult again = counted(kVariantCount, [&] { return plain_sweep(scene, surfaces); });
  result.seconds_ours = median_seconds(again);
  result.iterations_ours = mean_iterations(again);
  result.seconds_reference = median_seconds(result.reference);
  result.iterations_reference = mean_iterations(result.reference);
  return result;
}

}  // namespace condyle
