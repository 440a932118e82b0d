#include "condyle/results/comparison_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "condyle/results/run_layout.h"
#include "condyle/results/sweep_group.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {
namespace {

void write_number(const Hdf5Group& group, const char* name, double value, const char* units) {
  group.write(name, std::vector<double>{value}, {}, units);
}

std::vector<double> by_rows(const Eigen::Matrix3d& m) {
  std::vector<double> out;
  for (int i = 0; i < 9; ++i) out.push_back(m(i / 3, i % 3));
  return out;
}

void write_height(const Hdf5Group& group, const HeightFit& fit) {
  const HeightSurface& surface = fit.surface;
  std::vector<int> exponents;
  std::vector<double> coefficients, outline;
  for (const PolynomialTerm& term : surface.terms) {
    exponents.insert(exponents.end(), {term.i, term.j});
    coefficients.push_back(term.a);
  }
  for (const Eigen::Vector2d& corner : surface.outline)
    outline.insert(outline.end(), {corner.x(), corner.y()});
  group.write("degree", std::vector<int>{fit.degree}, {}, "1");
  group.write("fitted", std::vector<int>{fit.fitted ? 1 : 0}, {}, "1");
  group.write("points", std::vector<int>{fit.points}, {}, "1");
  group.write("origin", std::vector<double>(surface.origin.begin(), surface.origin.end()), {3},
              "mm");
  group.write("axes", by_rows(surface.axes), {3, 3}, "1");
  group.write("solid_below", std::vector<int>{surface.solid_below ? 1 : 0}, {}, "1");
  group.write("exponents", exponents, {coefficients.size(), 2}, "1");
  group.write("coefficients", coefficients, {coefficients.size()}, "mm^(1-i-j)");
  group.write("outline", outline, {surface.outline.size(), 2}, "mm");
  write_number(group, "rms_mm", fit.rms, "mm");
  write_number(group, "max_mm", fit.max, "mm");
}

HeightFit read_height(const Hdf5Group& group) {
  HeightFit fit;
  fit.degree = group.read_integers("degree", {})[0];
  fit.fitted = group.read_integers("fitted", {})[0] == 1;
  fit.points = group.read_integers("points", {})[0];
  const std::vector<double> origin = group.read("origin", {3}), axes = group.read("axes", {3, 3});
  for (int i = 0; i < 3; ++i) fit.surface.origin[i] = origin[i];
  for (int i = 0; i < 9; ++i) fit.surface.axes(i / 3, i % 3) = axes[i];
  fit.surface.solid_below = group.read_integers("solid_below", {})[0] == 1;
  const std::vector<double> coefficients = group.read("coefficients").values;
  const std::vector<int> exponents = group.read_integers("exponents", {coefficients.size(), 2});
  for (std::size_t t = 0; t < coefficients.size(); ++t)
    fit.surface.terms.push_back({exponents[2 * t], exponents[2 * t + 1], coefficients[t]});
  const std::vector<double> outline = group.read("outline").values;
  for (std::size_t i = 0; i + 1 < outline.size(); i += 2)
    fit.surface.outline.emplace_back(outline[i], outline[i + 1]);
  fit.rms = group.read("rms_mm", {})[0];
  fit.max = group.read("max_mm", {})[0];
  return fit;
}

/// Surfaces of contacts; the others have no outline, no term and no fit.
bool is_of_contact(const Scene& scene, std::size_t surface) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), [&](const auto& contact) {
    return contact.state != ContactState::kOpen &&
           (contact.surfaces[0] == static_cast<int>(surface) ||
            contact.surfaces[1] == static_cast<int>(surface));
  });
}

void write_springs(const Hdf5Group& group, const Scene& scene, const std::vector<ForceLaw>& laws) {
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const auto* law = std::get_if<QuadraticLaw>(&laws[i]);
    if (law == nullptr) continue;
    const Hdf5Group spring = group.create(scene.ligaments[i].name);
    write_number(spring, "stiffness", law->stiffness, "N/mm^2");
    write_number(spring, "slack_length", law->slack_length, "mm");
  }
}

/// Laws that were not converted are those of the scene.
std::vector<ForceLaw> read_springs(const Hdf5Group& group, const Scene& scene) {
  std::vector<ForceLaw> laws;
  for (const LigamentDescription& ligament : scene.ligaments) {
    laws.push_back(ligament.law);
    if (!group.has(ligament.name)) continue;
    const Hdf5Group spring = group.open(ligament.name);
    laws.back() = QuadraticLaw{spring.read("stiffness", {})[0], spring.read("slack_length", {})[0]};
  }
  return laws;
}

std::string group_name(Variant variant) {
  std::string text = name(variant);
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

}  // namespace

void write_comparison(const Hdf5Group& root, const Scene& scene, const Comparison& comparison) {
  const Hdf5Group reference = root.create("reference");
  reference.write("degree", std::vector<int>{comparison.options.degree}, {}, "1");
  write_number(reference, "matched_strain", comparison.options.strain, "1");
  write_sweep(reference.create("sweep"), scene, quantity_of_sweep(scene).unit,
              comparison.reference.poses);
  const Hdf5Group surfaces = reference.create("surfaces");
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    if (is_of_contact(scene, i))
      write_height(surfaces.create(scene.surfaces[i].name), comparison.heights[i]);
  }
  write_springs(reference.create("ligaments"), scene, comparison.springs);

  const Hdf5Group compare = root.create("compare");
  const Hdf5Group quantities = compare.create("quantities");
  for (const ComparedQuantity& quantity : comparison.quantities) {
    const Hdf5Group group = quantities.create(quantity.name);
    group.write_attribute("units", quantity.units);
    for (int v = 0; v < kVariantCount; ++v) {
      const std::vector<double>& values = quantity.values[v];
      group.write(group_name(static_cast<Variant>(v)), values, {values.size()}, quantity.units);
    }
  }
  compare.write("converged",
                std::vector<int>(comparison.converged.begin(), comparison.converged.end()),
                {kVariantCount}, "1");
  std::vector<std::string> names;
  for (int v = 0; v < kVariantCount; ++v) names.push_back(group_name(static_cast<Variant>(v)));
  compare.write_attribute("converged", "meaning", names);
  compare.write("seconds",
                std::vector<double>{comparison.seconds_ours, comparison.seconds_reference}, {2},
                "s");
  compare.write("iterations",
                std::vector<double>{comparison.iterations_ours, comparison.iterations_reference},
                {2}, "1");
}

Comparison read_comparison(const Hdf5Group& root, const Scene& scene) {
  Comparison comparison;
  const Hdf5Group reference = root.open("reference"), compare = root.open("compare");
  comparison.options.degree = reference.read_integers("degree", {})[0];
  comparison.options.strain = reference.read("matched_strain", {})[0];
  comparison.reference.poses =
      read_sweep(reference.open("sweep"), scene, quantity_of_sweep(scene).unit);
  comparison.heights.resize(scene.surfaces.size());
  const Hdf5Group surfaces = reference.open("surfaces");
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    if (is_of_contact(scene, i))
      comparison.heights[i] = read_height(surfaces.open(scene.surfaces[i].name));
  }
  comparison.springs = read_springs(reference.open("ligaments"), scene);
  const Shape n = {comparison.reference.poses.size()};
  const Hdf5Group quantities = compare.open("quantities");
  for (const std::string& name : quantities.names()) {
    const Hdf5Group group = quantities.open(name);
    ComparedQuantity quantity{name, group.read_attribute("units"), {}};
    for (int v = 0; v < kVariantCount; ++v)
      quantity.values[v] = group.read(group_name(static_cast<Variant>(v)), n);
    comparison.quantities.push_back(std::move(quantity));
  }
  const std::vector<int> converged = compare.read_integers("converged", {kVariantCount});
  std::copy(converged.begin(), converged.end(), comparison.converged.begin());
  const std::vector<double> seconds = compare.read("seconds", {2}),
                            iterations = compare.read("iterations", {2});
  comparison.seconds_ours = seconds[0];
  comparison.seconds_reference = seconds[1];
  comparison.iterations_ours = iterations[0];
  comparison.iterations_reference = iterations[1];
  return comparison;
}

}  // namespace condyle
